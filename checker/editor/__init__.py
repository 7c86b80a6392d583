"""The language server: diagnostics, completion and more for a package in an editor.

- A workspace has an overlay (`checker.package.overlay`): every text of a package is read
  through it. `with_overlay` gives the workspace another one and keeps all texts and parsed
  documents that have not changed, and the index of the disk. `--fix` uses the same.
- `session` has the open files and, for each of their packages, the last check. A change makes a
  new package, a new `Subject` and a new run of the static rules: nothing can be stale, and it
  takes a tenth of a second, since texts, meshes and expansions are known.
- Packages are read in one thread; the event loop continues. Weights and the trial run
  in a separate process (`full_check`), which the user can stop; its findings stay with their
  elements while the text changes (`measured`).
- Garbage is collected while the editor is idle: otherwise it takes half the time of a check.
"""
