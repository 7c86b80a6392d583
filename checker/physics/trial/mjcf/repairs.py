"""Changes and omissions of a scene, collected while it is built."""

from __future__ import annotations

from dataclasses import dataclass, field

from checker.physics.trial.trial import Repair

_MOST_NOTES = 40
"""More would hide what matters; a scene of thousands of parts has thousands of the same."""
_MOST_PARTS = 6


@dataclass
class Ledger:
    """Collects repairs and notes.

    Attributes:
        repairs: The repairs in the order in which they were needed.
    """

    repairs: list[Repair] = field(default_factory=list)
    _notes: dict[str, dict[str, None]] = field(default_factory=dict)

    def repair(self, part: str, what: str, *, serious: bool = False) -> None:
        """Add a repair; see `Repair`."""
        self.repairs.append(Repair(part, what, serious))

    def note(self, sentence: str, part: str) -> None:
        """Add a note about a part; what holds of many is stated once.

        Args:
            sentence: Ends without a full stop.
            part: Scoped name of a link or joint.
        """
        self._notes.setdefault(sentence, {})[part] = None

    @property
    def notes(self) -> tuple[str, ...]:
        """The notes, as sentences; of very many, the first."""
        notes = [f"{sentence}: {_listed(list(parts))}." for sentence, parts in self._notes.items()]
        if len(notes) > _MOST_NOTES:
            rest = len(notes) - _MOST_NOTES
            notes = [*notes[:_MOST_NOTES], f"{rest} more notes are left out."]
        return tuple(notes)


def _listed(parts: list[str]) -> str:
    listed = ", ".join(parts[:_MOST_PARTS])
    rest = len(parts) - _MOST_PARTS
    return f"{listed} and {rest} more" if rest > 0 else listed
