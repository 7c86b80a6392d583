"""Which links move by themselves, and which one carries each of the others."""

from __future__ import annotations

from checker.model.tree import WORLD
from checker.physics.trial.mjcf.scene import Scene

TRACKED = 200
"""Links whose motion is kept; of a robot with more of them, none is."""


def carriers_of(scene: Scene) -> dict[str, str]:
    """Return the link that carries each link, by scoped names; itself for one that moves.

    What is fixed to the world is carried by the first such link. Nothing of a robot with more than
    `TRACKED` moving links.
    """
    fixed = next((name for name, base in scene.welded.items() if _stays(name, base)), WORLD)
    carriers = {
        name: fixed if base == WORLD else base
        for name, base in scene.welded.items()
        if name != WORLD
    }
    return carriers if len(set(carriers.values())) <= TRACKED else {}


def _stays(name: str, base: str) -> bool:
    return base == WORLD and name != WORLD
