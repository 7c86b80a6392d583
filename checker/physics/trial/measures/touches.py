"""The contacts with the ground: copied while the robot drives, worked out when it has stopped."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

from checker.base.record import Record
from checker.physics.trial.simulation.rig import Rig

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]
    Numbers = NDArray[np.int64]


class Touches(Record):
    """Contacts in a stretch of time: n samples, and k contacts in their order.

    Attributes:
        names: Scoped names of the robot's links.
        time: Of each sample, seconds (n).
        anchors: Where the joints with a servo are, in the robot's frame, metres (n × joints × 3).
        axes: Their axes, in the robot's frame (n × joints × 3).
        sample: Of each contact, the number of its sample (k).
        link: Of each contact, the number of the link that touches (k).
        points: Where, in the robot's frame, metres (k × 3).
        loads: Normal forces, N (k).
        friction: Coefficients (k).
        depth: Penetration, metres (k).
    """

    names: tuple[str, ...]
    time: Array
    anchors: Array
    axes: Array
    sample: Numbers
    link: Numbers
    points: Array
    loads: Array
    friction: Array
    depth: Array

    def between(self, start: float, end: float) -> Touches:
        """Return the contacts of a stretch of time, seconds, its end excluded."""
        import numpy as np

        first, behind = np.searchsorted(self.time, (start, end))
        samples = slice(first, behind)
        rows = slice(*np.searchsorted(self.sample, (first, behind)))
        return Touches(
            names=self.names,
            time=self.time[samples],
            anchors=self.anchors[samples],
            axes=self.axes[samples],
            sample=self.sample[rows] - first,
            link=self.link[rows],
            points=self.points[rows],
            loads=self.loads[rows],
            friction=self.friction[rows],
            depth=self.depth[rows],
        )


class _Copied(NamedTuple):
    """What MuJoCo holds after a step; arrays have a row a contact, if nothing else is said."""

    time: float
    place: Array
    turn: Array
    anchors: Array
    axes: Array
    geoms: Numbers
    points: Array
    friction: Array
    distance: Array
    address: Numbers
    forces: Array


@dataclass
class ContactLog:
    """Copies contacts, step by step: working them out together takes a fraction of the time."""

    _copied: list[_Copied] = field(default_factory=list)

    def add(self, rig: Rig, time: float) -> None:
        """Copy the contacts of MuJoCo's last step."""
        data, contact = rig.data, rig.data.contact
        self._copied.append(
            _Copied(
                time,
                data.xpos[rig.root].copy(),
                data.xmat[rig.root].copy(),
                data.xanchor[rig.joints],
                data.xaxis[rig.joints],
                contact.geom.copy(),
                contact.pos.copy(),
                contact.friction[:, 0].copy(),
                contact.dist.copy(),
                contact.efc_address.copy(),
                data.efc_force.copy(),
            )
        )

    def touches(self, rig: Rig) -> Touches:
        """Return all that was copied, in the frame that the robot had at each time."""
        import numpy as np

        # The same record once more, of columns.
        copied = _Copied._make(zip(*self._copied, strict=True))
        counts = [len(each) for each in copied.geoms]
        sample = np.repeat(np.arange(len(counts)), counts)
        behind = np.cumsum([0, *map(len, copied.forces)])
        address = np.concatenate(copied.address)
        # A contact that the solver left out has no force.
        used = address >= 0
        sample, row = sample[used], (behind[sample] + address)[used]
        place, turn = rig.frame(np.array(copied.place), np.array(copied.turn))
        points = np.concatenate(copied.points)[used] - place[sample]
        names = tuple(dict.fromkeys(rig.parts))
        numbers = np.array([names.index(part) for part in rig.parts])
        return Touches(
            names=names,
            time=np.array(copied.time),
            anchors=(np.array(copied.anchors) - place[:, None]) @ turn,
            axes=np.array(copied.axes) @ turn,
            sample=sample,
            # The ground is the first geom.
            link=numbers[np.concatenate(copied.geoms)[used].max(axis=1)],
            points=(points[:, None] @ turn[sample])[:, 0],
            loads=np.concatenate(copied.forces)[row],
            friction=np.concatenate(copied.friction)[used],
            depth=-np.concatenate(copied.distance)[used],
        )
