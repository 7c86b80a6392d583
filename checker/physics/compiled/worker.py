"""Compiles models in MuJoCo and simulates them: the module behind `checker.base.child_process`."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from typing import Any

from checker.base.sandbox.files import NO_FILES, Files

_LINE = re.compile(r"line (\d+)")
_LEAVES_OUT = re.compile(
    r"unrecognized attribute|bad format in attribute|invalid keyword|unknown default class"
    r"|not found in geom|does not have enough data|has too much data|unknown transmission"
)
"""Messages about an attribute, or about what only an actuator needs."""
_QUOTED = re.compile(r"'([^']*)'")
_ATTRIBUTE = re.compile(r' ([\w:.-]+)="([^"]*)"')
_LEAF = re.compile(r"<(\w+)[^>]*></\1>")
_MAY_GO = ("class", "childclass", "material", "texture")
"""Attributes that name something and that a model can do without."""
_LEAVES = (
    *("general", "motor", "position", "velocity", "intvelocity", "damper", "cylinder"),
    *("muscle", "adhesion", "exclude", "pair"),
)
"""Elements to which no other one refers."""
_NO_DENSITY = 1e-9
"""Instead of 0, with which MuJoCo refuses a mesh."""
_NO_MOMENT = 1e-12
_REFUSALS_LIMIT = 20
_SECONDS = 1.0
"""Simulated, from the first keyframe on."""
_STEPS_LIMIT = 5_000
_CONTACTS_LIMIT = 200


def answer(request: bytes, files: Files = NO_FILES) -> bytes:
    """Compile models.

    Args:
        request: JSON; `items` with `text`, `attached` and `files` each, as `MujocoText` has them.
        files: The content of the files, by their paths on disk.

    Returns:
        JSON of what MuJoCo made of each; see `checker.physics.compiled.model`.
    """
    return json.dumps([_compiled(item, files) for item in json.loads(request)["items"]]).encode()


def _compiled(item: Mapping[str, Any], files: Files) -> dict[str, Any]:
    import mujoco

    attached = {name: text.encode() for name, text in item["attached"].items()}
    assets = dict[str, bytes]()
    for name, place in item["files"].items():
        content = files.read(place)
        if isinstance(content, bytes):
            assets[name] = content
    text, refusals = item["text"], list[dict[str, Any]]()
    while len(refusals) < _REFUSALS_LIMIT:
        try:
            spec = mujoco.MjSpec.from_string(text, include=attached | assets, assets=assets)
            model = spec.compile()
        except (ValueError, mujoco.FatalError) as refusal:
            refused = str(refusal)
            line = _LINE.search(refused)
            refusals.append({"text": refused, "line": int(line[1]) if line else 0})
            mended = _without(text, refused, refusals[-1]["line"])
            if mended == text:
                break
            text = mended
        else:
            lacks = {"lacks_meshes": _lacks(spec, item["absent"])}
            return {"refusals": refusals, **lacks, **_facts(spec, model), **_first_second(model)}
    return {"refusals": refusals}


def _without(text: str, refused: str, number: int) -> str:
    """Return the text without what MuJoCo refuses on a line, so that more can be judged.

    An attribute that its message names, or whose value it names, is left out, or else the whole
    element if nothing else refers to it. The same text is returned if that is not possible.
    """
    lines = text.split("\n")
    if not (0 < number <= len(lines) and _LEAVES_OUT.search(refused)):
        return text
    line, named = lines[number - 1], _QUOTED.findall(refused)
    stated = _ATTRIBUTE.findall(line)
    for name, value in stated:
        if name in named or (name in _MAY_GO and value in named):
            lines[number - 1] = line.replace(f' {name}="{value}"', "", 1)
            return "\n".join(lines)
    leaf = _LEAF.match(line)
    if leaf is not None and leaf[1] in _LEAVES:
        lines[number - 1] = line[leaf.end() :]
        return "\n".join(lines)
    return text


def _lacks(spec: Any, absent: list[str]) -> bool:
    """Return whether a shape of an absent mesh or height field collides or has mass."""
    names = {*absent}
    return any(
        (geom.meshname or geom.hfieldname) in names
        and (
            geom.contype
            or geom.conaffinity
            or not (geom.parent.explicitinertial or geom.mass == 0 or geom.density == 0)
        )
        for geom in spec.geoms
    )


def _line(element: Any) -> int:
    found = _LINE.search(element.info)
    return int(found[1]) if found else 0


def _facts(spec: Any, model: Any) -> dict[str, Any]:
    """Return the parts of a model in its reference pose, each with the line of its element."""
    import mujoco

    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    visual = _visual_masses(spec, model)
    stated = {body.id for body in spec.bodies if body.explicitinertial}
    parts = {
        "bodies": spec.bodies,
        "joints": spec.joints,
        "geoms": spec.geoms,
        "actuators": spec.actuators,
    }
    lines = {kind: {it.id: _line(it) for it in elements} for kind, elements in parts.items()}
    # Some actuators have several controls: `nu` is not their number.
    actuators = range(len(model.actuator_trntype))
    return {
        "sizes": {"nq": model.nq, "nv": model.nv, "nu": model.nu, "na": model.na},
        "timestep": float(model.opt.timestep),
        "integrator": int(model.opt.integrator),
        "bodies": [
            {
                **_body(model, data, i, lines["bodies"]),
                "stated": i in stated,
                "visual_mass": visual.get(i, 0.0),
            }
            for i in range(model.nbody)
        ],
        "joints": [_joint(model, data, i, lines) for i in range(model.njnt)],
        "geoms": [_geom(model, i, lines["geoms"]) for i in range(model.ngeom)],
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
        "centre": data.xipos[i].tolist(),
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
        "friction": float(model.dof_frictionloss[dof]),
    }


def _geom(model: Any, i: int, lines: Mapping[int, int]) -> dict[str, Any]:
    return {
        "line": lines.get(i, 0),
        "name": _name(model.name_geomadr[i], model.names),
        "body": int(model.geom_bodyid[i]),
        "collides": bool(model.geom_contype[i] or model.geom_conaffinity[i]),
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


def _first_second(model: Any) -> dict[str, Any]:
    """Return the contacts at the start, and what goes wrong within the first second."""
    import mujoco

    data = mujoco.MjData(model)
    if model.nkey:
        mujoco.mj_resetDataKeyframe(model, data, 0)
    mujoco.mj_forward(model, data)
    contacts = [*_contacts(data)]
    # A state that is reset starts again, so that the fault would be hidden.
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_AUTORESET
    steps = max(1, min(_STEPS_LIMIT, int(_SECONDS / max(model.opt.timestep, 1e-6))))
    fastest, trouble, time = 0.0, "", 0.0
    for _ in range(steps):
        mujoco.mj_step(model, data)
        fastest = max(fastest, float(abs(data.qvel).max(initial=0.0)))
        time = float(data.time)
        if trouble := _trouble(data):
            break
    return {
        "at_key": bool(model.nkey),
        "contacts": contacts,
        "trouble": trouble,
        "time": time,
        "fastest": fastest,
    }


def _trouble(data: Any) -> str:
    import mujoco

    kinds = {
        "position": mujoco.mjtWarning.mjWARN_BADQPOS,
        "velocity": mujoco.mjtWarning.mjWARN_BADQVEL,
        "acceleration": mujoco.mjtWarning.mjWARN_BADQACC,
    }
    return next((name for name, kind in kinds.items() if data.warning[kind].number), "")


def _contacts(data: Any) -> Iterator[dict[str, Any]]:
    for contact in data.contact[:_CONTACTS_LIMIT]:
        yield {"geoms": [int(it) for it in contact.geom], "distance": float(contact.dist)}
