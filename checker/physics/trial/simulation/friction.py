"""Friction of wheels that differs along their way and along their axle, or acts along rollers."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from checker.physics.trial.plan import DrivenWheel

_ACROSS = 0.1
"""Sine of the angle between an axle and the normal of a contact; below it, the wheel lies flat."""


class DirectedFriction:
    """The contacts of wheels whose friction has a direction.

    MuJoCo has two coefficients for a contact, along axes of its own choice: these are turned to the
    wheel after contacts are found.

    Attributes:
        needed: Whether any wheel has it.
    """

    def __init__(
        self,
        data: Any,
        parts: Sequence[str],
        wheels: Iterable[DrivenWheel],
        joints: Mapping[str, int],
    ) -> None:
        """Find the shapes of such wheels.

        Args:
            data: MuJoCo's.
            parts: The scoped name of the link of each geom.
            wheels: Wheels that turn.
            joints: The numbers of their joints, by scoped name.
        """
        import numpy as np

        self._data = data
        self._joint = np.full(len(parts), -1)
        self._friction = np.zeros((len(parts), 2))
        self._rollers = np.zeros(len(parts))
        directed = {link: wheel for wheel in wheels if wheel.friction for link in wheel.links}
        for geom, link in enumerate(parts):
            if (wheel := directed.get(link)) is not None:
                self._joint[geom] = joints[wheel.joint]
                self._friction[geom] = wheel.friction
                self._rollers[geom] = wheel.rollers or 0.0
        self.needed = bool((self._joint >= 0).any())

    def apply(self) -> bool:
        """Turn the axes of contacts of such wheels; return whether there are any."""
        import numpy as np

        contact = self._data.contact
        # The ground is the first geom.
        geoms = contact.geom.max(axis=1, initial=0)
        touching = np.flatnonzero(self._joint[geoms] >= 0)
        if not touching.size:
            return False
        geoms = geoms[touching]
        tangents = contact.frame[touching, 3:].reshape(-1, 2, 3)
        axle = np.matmul(tangents, self._data.xaxis[self._joint[geoms], :, None])[:, :, 0]
        # In the plane of the contact, the first axis turns by this angle to the wheel's way.
        turn = self._rollers[geoms] - np.arctan2(axle[:, 0], axle[:, 1])
        cosine, sine = np.cos(turn), np.sin(turn)
        turned = np.stack((cosine, sine, -sine, cosine), axis=1).reshape(-1, 2, 2) @ tangents
        rolls = np.hypot(axle[:, 0], axle[:, 1]) > _ACROSS
        contact.frame[touching[rolls], 3:] = turned[rolls].reshape(-1, 6)
        contact.friction[touching[rolls], :2] = self._friction[geoms[rolls]]
        return bool(rolls.any())
