"""The first second of a model of MuJoCo, from its first keyframe on."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

_SECONDS = 1.0
_STEPS_LIMIT = 5_000
_CONTACTS_LIMIT = 200


def first_second(model: Any) -> dict[str, Any]:
    """Return the contacts at the start, and what goes wrong within the first second."""
    import mujoco

    data = mujoco.MjData(model)
    if model.nkey:
        mujoco.mj_resetDataKeyframe(model, data, 0)
    mujoco.mj_forward(model, data)
    contacts = [*_contacts(model, data)]
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


def _contacts(model: Any, data: Any) -> Iterator[dict[str, Any]]:
    for contact in data.contact[:_CONTACTS_LIMIT]:
        bodies = [int(model.geom_bodyid[geom]) for geom in contact.geom]
        yield {"bodies": bodies, "distance": float(contact.dist)}
