"""Computations about a robot: meshes, masses, views of sensors, the trial.

- Every engine gets the same robot model. `robot.locomotion` has the parts that its plugins move:
  wheels, tracks, rotors, with their limits. `robot.meshes` has the content of its mesh files.
- Mesh files, xacro, the trial and pictures are read, run and drawn in sandboxed child processes
  with limits (`checker.base.background` looks in the cache, then starts a child process). One
  child process reads the mesh files of a whole check. If it dies, rules are *not checked*, and
  the check continues.
- In `trial`, `mjcf.scene` writes the robot as MJCF, and `drivers` plan what each kind of drive
  commands over the legs of `course`. Both go to the child, where `worker` has `simulation`
  drive and `measures` collect the figures; `trial` is the result. `recording` drives the
  same for `export`.
- The trial starts before the rules and drives while they run; the first rule that needs it
  waits.
- Results are kept by the hash of all that they depend on (`checker.base.cache`).
- The same robot in Pinocchio and in MuJoCo has the same mass, centre of mass and joint-space
  inertia to 1e-9: a permanent test of both. No threshold and no special case names a robot.
"""
