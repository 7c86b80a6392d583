"""optical_frame_publisher: the node that gives a camera's pictures out in its optical frame.

Gazebo's cameras look along x, ROS's image programs expect z. The node of subt_ros takes
`input/image` and `input/camera_info` and gives `output/image` and `output/camera_info`, all by
remaps; started with the argument `depth` it does without camera_info.
"""

from __future__ import annotations

from collections.abc import Iterable

from checker.model.launch.graph import Node
from checker.model.launch.names import resolve_name
from checker.record import record

PROGRAM = "optical_frame_publisher"
IMAGES = ("input/image", "output/image")
INFOS = ("input/camera_info", "output/camera_info")


@record(eq=False)
class OpticalFrame:
    """One optical_frame_publisher.

    Attributes:
        node: The node.
        needed: The names that it must have remaps of.
        remapped: Those of its names that have one, each with the absolute topic it stands for.
    """

    node: Node
    needed: tuple[str, ...]
    remapped: dict[str, str]

    @property
    def input_image(self) -> str:
        """The absolute topic that it takes pictures from; empty when no remap names it."""
        return self.remapped.get("input/image", "")


def optical_frames(nodes: Iterable[Node]) -> tuple[OpticalFrame, ...]:
    """Return the optical_frame_publishers among some nodes."""
    return tuple(_read(node) for node in nodes if node.type == PROGRAM)


def _read(node: Node) -> OpticalFrame:
    sources = {resolve_name(remap.source, node.namespace, node.name) for remap in node.remaps}
    names = [
        name
        for name in (*IMAGES, *INFOS)
        if resolve_name(name, node.namespace, node.name) in sources
    ]
    needed = IMAGES if "depth" in node.args.split() else (*IMAGES, *INFOS)
    return OpticalFrame(node, needed, {name: node.resolve(name) for name in names})
