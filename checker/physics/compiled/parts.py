"""The parts of a model of MuJoCo, each with the line of its text."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

_LINE = re.compile(r"line (\d+)")
_NO_DENSITY = 1e-9
"""Instead of 0, with which MuJoCo refuses a mesh."""
_NO_MOMENT = 1e-12
_VISUAL_GROUPS = (1, 2)
"""Groups of what is only seen: of MuJoCo's importer of URDF and robosuite, and of Menagerie."""


def stated_line(text: str) -> int:
    """Return the line that a message or element of MuJoCo names; 0 for none."""
    found = _LINE.search(text)
    return int(found[1]) if found else 0


def model_parts(spec: Any, model: Any) -> dict[str, Any]:
    """Return the parts of a model in its reference pose, each with the line of its element."""
    import mujoco

    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    shown = _colliding_visuals(spec, model)
    visual = _visual_masses(spec, model)
    stated = {body.id for body in spec.bodies if body.explicitinertial}
    parts = {
        "bodies": spec.bodies,
        "joints": spec.joints,
        "actuators": spec.actuators,
    }
    lines = {
        kind: {it.id: stated_line(it.info) for it in elements} for kind, elements in parts.items()
    }
    # Some actuators have several controls: `nu` is not their number.
    actuators = range(len(model.actuator_trntype))
    return {
        "sizes": {"nq": model.nq, "nv": model.nv, "nu": model.nu, "na": model.na},
        "timestep": float(model.opt.timestep),
        "bodies": [
            {
                **_body(model, data, i, lines["bodies"]),
                "stated": i in stated,
                "visual_mass": visual.get(i, 0.0),
                "colliding_visuals": shown.get(i, []),
            }
            for i in range(model.nbody)
        ],
        "joints": [_joint(model, data, i, lines) for i in range(model.njnt)],
        "actuators": [_actuator(model, i, lines["actuators"]) for i in actuators],
        **_coupled(model),
        "idle": _idle(model),
    }


def _name(address: Any, names: bytes) -> str:
    return names[address : names.index(b"\0", address)].decode("utf-8", "replace")


def _body(model: Any, data: Any, i: int, lines: Mapping[int, int]) -> dict[str, Any]:
    return {
        "line": lines.get(i, 0),
        "name": _name(model.name_bodyadr[i], model.names),
        "parent": int(model.body_parentid[i]),
        "welded": int(model.body_weldid[i]),
        "mass": float(model.body_mass[i]),
        "inertia": model.body_inertia[i].tolist(),
        "position": data.xpos[i].tolist(),
        "reach": _reach(model, i),
    }


def _reach(model: Any, body: int) -> float:
    """Return how far the shapes of a body are from its centre of mass at most; 0 without any."""
    import numpy as np

    first, number = model.body_geomadr[body], model.body_geomnum[body]
    geoms = range(first, first + number) if number else range(0)
    centre = model.body_ipos[body]
    far = (np.linalg.norm(model.geom_pos[it] - centre) + model.geom_rbound[it] for it in geoms)
    return float(max(far, default=0.0))


def _colliding_visuals(spec: Any, model: Any) -> dict[int, list[int]]:
    """Return the lines of visual meshes that collide, by their body with other shapes that do."""
    import mujoco

    visual: dict[int, list[int]] = {}
    simple = set[int]()
    off = model.opt.disableflags & mujoco.mjtDisableBit.mjDSBL_CONTACT
    for geom in spec.geoms if not off else ():
        body = int(model.geom_bodyid[geom.id])
        if not _meets_others(model, geom.id):
            continue
        is_mesh = geom.type == mujoco.mjtGeom.mjGEOM_MESH
        if is_mesh and (geom.group in _VISUAL_GROUPS or "visual" in geom.classname.name.lower()):
            visual.setdefault(body, []).append(stated_line(geom.info))
        else:
            simple.add(body)
    return {body: lines for body, lines in visual.items() if body in simple}


def _meets_others(model: Any, geom: int) -> bool:
    """Return whether the bits of a shape and those of one of another body make contacts."""
    found = (model.geom_contype[geom] & model.geom_conaffinity) | (
        model.geom_conaffinity[geom] & model.geom_contype
    )
    return bool(found[model.geom_bodyid != model.geom_bodyid[geom]].any())


def _visual_masses(spec: Any, model: Any) -> dict[int, float]:
    """Return the mass that meshes which collide with nothing add to bodies with other shapes.

    The model is compiled again without the mass of these meshes.
    """
    import mujoco

    least, most = spec.compiler.inertiagrouprange
    only_seen: dict[int, list[Any]] = {}
    colliding = set[int]()
    for geom in spec.geoms:
        body = int(model.geom_bodyid[geom.id])
        if geom.mass == 0 or not geom.density or not least <= geom.group <= most:
            continue
        if geom.contype or geom.conaffinity:
            colliding.add(body)
        elif geom.type == mujoco.mjtGeom.mjGEOM_MESH and geom.mass != geom.mass:  # none is stated
            only_seen.setdefault(body, []).append(geom)
    weighed = [it.id for it in spec.bodies if not it.explicitinertial and it.id in colliding]
    bodies = [body for body in weighed if body in only_seen]
    for geom in (geom for body in bodies for geom in only_seen[body]):
        geom.density = _NO_DENSITY
    try:
        bare = spec.compile() if bodies else model
    except ValueError:  # other shapes of a body weigh nothing
        return {}
    return {body: float(model.body_mass[body] - bare.body_mass[body]) for body in bodies}


def _joint(model: Any, data: Any, i: int, lines: Mapping[str, Mapping[int, int]]) -> dict[str, Any]:
    dof, body = model.jnt_dofadr[i], int(model.jnt_bodyid[i])
    return {
        # MuJoCo knows no line of a <freejoint>.
        "line": lines["joints"].get(i) or lines["bodies"].get(body, 0),
        "name": _name(model.name_jntadr[i], model.names),
        "type": ("free", "ball", "slide", "hinge")[model.jnt_type[i]],
        "body": body,
        "limited": bool(model.jnt_limited[i]),
        "range": model.jnt_range[i].tolist(),
        "axis": data.xaxis[i].tolist(),
        "stiffness": float(model.jnt_stiffness[i].max()),
        "damping": float(model.dof_damping[dof].max()),
        "armature": float(model.dof_armature[dof]),
    }


def _coupled(model: Any) -> dict[str, list[int]]:
    """Return the joints that equalities hold, and those of fixed tendons."""
    import mujoco

    held = set[int]()
    for number, kind in enumerate(model.eq_type):
        if kind == mujoco.mjtEq.mjEQ_JOINT:
            held |= {int(model.eq_obj1id[number]), int(model.eq_obj2id[number])}
    wrapped = zip(model.wrap_type, model.wrap_objid, strict=True)
    in_tendons = {int(joint) for kind, joint in wrapped if kind == mujoco.mjtWrap.mjWRAP_JOINT}
    return {"held": sorted(held), "in_tendons": sorted(in_tendons)}


def _idle(model: Any) -> list[int]:
    """Return the actuators without a moment about any joint, in two poses."""
    import mujoco

    data = mujoco.MjData(model)
    moved = set[int]()
    for step in (0.0, 0.1):
        mujoco.mj_integratePos(model, data.qpos, [step] * model.nv, 1.0)
        mujoco.mj_forward(model, data)
        moment = data.actuator_moment
        for number, (start, length) in enumerate(
            zip(data.moment_rowadr, data.moment_rownnz, strict=True)
        ):
            if abs(moment[start : start + length]).max(initial=0.0) > _NO_MOMENT:
                moved.add(number)
    kinds = model.actuator_trntype
    by_tendon = [it for it, kind in enumerate(kinds) if kind == mujoco.mjtTrn.mjTRN_TENDON]
    return [number for number in by_tendon if number not in moved]


def _actuator(model: Any, i: int, lines: Mapping[int, int]) -> dict[str, Any]:
    import mujoco

    of_joint = model.actuator_trntype[i] == mujoco.mjtTrn.mjTRN_JOINT
    return {
        "line": lines.get(i, 0),
        "name": _name(model.name_actuatoradr[i], model.names),
        "joint": int(model.actuator_trnid[i][0]) if of_joint else -1,
        "gain": float(model.actuator_gainprm[i][0]),
        "stiffness": -float(model.actuator_biasprm[i][1]),
        "damping": -float(model.actuator_biasprm[i][2]),
        "gear": float(model.actuator_gear[i][0]),
        "plain": bool(
            model.actuator_dyntype[i] == mujoco.mjtDyn.mjDYN_NONE
            and model.actuator_gaintype[i] == mujoco.mjtGain.mjGAIN_FIXED
            and model.actuator_plugin[i] < 0
        ),
        "ctrl_limited": bool(model.actuator_ctrllimited[i]),
        "ctrl_range": model.actuator_ctrlrange[i].tolist(),
        "force_limited": bool(model.actuator_forcelimited[i]),
        "force_range": model.actuator_forcerange[i].tolist(),
    }
