"""Fixed joints in Gazebo Classic, which merges the links that they connect into one."""

from __future__ import annotations

from functools import cached_property

from checker.base.record import Record
from checker.formats.urdf.description import UrdfDescription
from checker.formats.urdf.extensions import extension_flag
from checker.model.components import Joint, Link

_KEEPING = ("preserveFixedJoint", "disableFixedJointLumping")
"""Tags below `<gazebo reference="joint">` that keep a fixed joint, or the link below it."""


class Lumping(Record, eq=False, dict=True):
    """The links of a description as Gazebo Classic merges them.

    Attributes:
        description: The description.
    """

    description: UrdfDescription

    @cached_property
    def kept_joints(self) -> frozenset[str]:
        """Names of the fixed joints that a `<gazebo>` tag keeps."""
        return frozenset(
            tag.reference.value
            for tag in self.description.gazebo
            if any(extension_flag(tag.element, name) for name in _KEEPING)
        )

    @cached_property
    def merged(self) -> dict[str, Joint]:
        """The fixed joint above each link that is merged into its parent, by the link's name."""
        robot = self.description.robot
        return {
            joint.child.value: joint
            for joint in reversed(robot.joints)
            if joint.type.value == "fixed"
            and joint.name.value not in self.kept_joints
            and joint.parent.value in robot.links_by_name
            and joint.parent.value != "world"
        }

    def holder(self, link: str) -> str:
        """Return the name of the link that a link is merged into; its own when it stays."""
        seen = set()
        while link in self.merged and link not in seen:
            seen.add(link)
            link = self.merged[link].parent.value
        return link

    @cached_property
    def groups(self) -> dict[str, list[Link]]:
        """The links that become one, by the name of the link that they are merged into."""
        groups: dict[str, list[Link]] = {}
        for link in self.description.robot.links:
            groups.setdefault(self.holder(link.name.value), []).append(link)
        return groups
