"""Conventions of URDF: the facts that the format states."""

from __future__ import annotations

from checker.model.conventions import Conventions

CONVENTIONS = Conventions(
    joint_types="urdf",
    joint_posed_in="parent",
    has_frames=False,
    has_default_axis=True,
    has_massless_links=True,
    merges_fixed_links=True,
    states_start=False,
    states_devices=False,
    has_named_materials=True,
    extension_tag="gazebo",
)
