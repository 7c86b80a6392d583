"""The friction of a collision, as far as MuJoCo can have it: one coefficient in all directions."""

from __future__ import annotations

from checker.model.components import Collision, Link
from checker.model.friction import FrictionReader
from checker.trial.mjcf_text import bounded
from checker.trial.repairs import Ledger

MOST = 1.5
"""Rubber on rock; larger ones are tricks of other solvers, and stiffen MuJoCo's contacts."""
_DEFAULT = 1.0
_ALIKE = 0.1
"""Share by which the second coefficient may differ before a note says that it is left out."""


def sliding_friction(
    reader: FrictionReader, link: Link, collision: Collision, ledger: Ledger
) -> float:
    """Return the coefficient of sliding friction of a collision, 0…`MOST`.

    MuJoCo has no friction directions of a shape's own: the first coefficient counts.
    """
    stated = reader.of(link, collision)
    mu = stated.first.value if stated.first is not None else _DEFAULT
    other = stated.second.value if stated.second is not None else mu
    taken = bounded(mu, 0.0, MOST, _DEFAULT)
    if abs(min(other, MOST) - min(mu, MOST)) > _ALIKE * max(mu, _ALIKE):
        ledger.note(
            f"Friction is {mu:g} in its first direction and {other:g} in its second; the trial "
            f"uses {taken:g} for both",
            link.scoped_name,
        )
    return taken


def touches(collision: Collision) -> bool:
    """Return whether a collision pushes what it touches, and not only feels it."""
    surface = collision.element.child("surface")
    contact = surface.child("contact") if surface is not None else None
    if contact is None:
        return True
    bits = contact.child("collide_bitmask")
    without = contact.child("collide_without_contact")
    ghost = without is not None and without.text.value.strip().lower() in ("1", "true")
    return not ghost and (bits is None or bits.text.value.strip() not in ("0", "0x0", "0x00"))
