"""Conventions of robot formats: the facts that each format states."""

from __future__ import annotations

from typing import Literal

from checker.base.record import Record


class Conventions(Record):
    """The conventions of one format of robots.

    Attributes:
        joint_types: The format whose types of joints it has, in the table `joint_types.json`.
        joint_posed_in: The link in whose frame the pose of a joint is, unless it names another.
        has_frames: Whether `world` and the names of models and joints can be used as frames.
        has_default_axis: Whether a joint without an axis has a default one.
        has_massless_links: Whether a link without mass is right: a frame with a name.
        merges_fixed_links: Whether the simulator makes one body of links with a fixed joint.
        states_start: Whether it states where the robot stands and how its joints start.
        states_devices: Whether it lists all sensors and all that drives joints; otherwise other
            files can add some.
        has_named_materials: Whether a visual can name a material of another one, or of the robot.
        read_by_gazebo: Whether Gazebo is its only reader.
        extension_tag: Element with settings of Gazebo, in a format that others read too.
    """

    joint_types: str
    joint_posed_in: Literal["parent", "child"]
    has_frames: bool
    has_default_axis: bool
    has_massless_links: bool
    merges_fixed_links: bool
    states_start: bool
    states_devices: bool
    has_named_materials: bool = False
    read_by_gazebo: bool = False
    extension_tag: str = ""

    @property
    def is_urdf(self) -> bool:
        """True if it is written as URDF, with numbers in attributes."""
        return self.joint_types == "urdf"
