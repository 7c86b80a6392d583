"""Conventions of SDF: the facts that the format states."""

from __future__ import annotations

from checker.model.conventions import Conventions

CONVENTIONS = Conventions(
    joint_types="sdf",
    joint_posed_in="child",
    has_frames=True,
    has_default_axis=False,
    has_massless_links=False,
    merges_fixed_links=False,
    states_start=True,
    states_devices=True,
    read_by_gazebo=True,
)
