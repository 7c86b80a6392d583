"""All that is measured in a trial."""

from __future__ import annotations

import math
from collections.abc import Iterator

from checker.trial.measure_drive import measure_drive
from checker.trial.measure_energy import measure_energy
from checker.trial.measure_flight import measure_flight
from checker.trial.measure_hold import measure_hold
from checker.trial.measure_loads import measure_loads
from checker.trial.measure_settle import measure_settle
from checker.trial.measure_torque import measure_torque
from checker.trial.measure_turn import measure_turn
from checker.trial.motion import Motion
from checker.trial.trial import Measurement

_MEASURES = (
    measure_settle,
    measure_drive,
    measure_turn,
    measure_loads,
    measure_torque,
    measure_flight,
    measure_hold,
    measure_energy,
)


def measured(motion: Motion) -> Iterator[Measurement]:
    """Yield the figures of a run; those that are no finite numbers are none."""
    for measure in _MEASURES:
        for each in measure(motion):
            if math.isfinite(each.value):
                yield each
