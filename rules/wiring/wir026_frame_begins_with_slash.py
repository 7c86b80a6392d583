"""A frame of Nav2 by a name with a slash in front.

tf2 refuses such a name ("frame_ids cannot start with a '/'"). A costmap with one waits for a
transform that never comes, so it is not activated, and nothing of Nav2 after it is. In bt_navigator
and behavior_server it is the robot's pose that is never known. With several robots, the slash in
front of a name was right with the first tf, `/robot1/base_link`; it is `robot1/base_link` now.

It is reported for the costmaps, bt_navigator and behavior_server; not where a launch file names the
parameter, which may replace it.

Fix: write the name without the slash.
Source: tf2, BufferCore::canTransform; navigation2, Costmap2DROS::on_activate.
"""

from checker.package.package import Package
from checker.ros.wiring.costmaps import COSTMAPS
from checker.ros.wiring.parameters import blocks_in
from checker.rule import Concern, Findings, Severity, finding, rename, rule

_FRAMES = ("global_frame", "robot_base_frame")
_NODES = (*COSTMAPS, "bt_navigator", "behavior_server")


@rule("WIR026", "frame-begins-with-slash", Severity.ERROR, Concern.INTERFACE)
def check(package: Package) -> Findings:
    """Report frames of Nav2's nodes that tf2 refuses."""
    names = [it for it in _FRAMES if not package.workspace.launches_with(it)]
    for file in package.index.with_suffix(".yaml", ".yml"):
        for block in blocks_in(package, file.path, "_frame"):
            for name in names if block.node in _NODES else ():
                parameter = block.parameters.get(name)
                for frame in parameter.texts if parameter is not None else ():
                    if frame.value.startswith("/"):
                        bare = frame.value.lstrip("/")
                        of_costmap = block.node in COSTMAPS
                        effect = "is never activated" if of_costmap else "never finds the robot"
                        yield finding(
                            frame,
                            f"{name} {frame.value!r} of {block.node} begins with a slash, which "
                            f"tf2 refuses, so {block.node} {effect}: write {bare}",
                            severity=None if of_costmap else Severity.WARNING,
                            fix=rename(frame, bare),
                        )


def _example(node: str, frame: str, mark: str = "") -> dict[str, object]:
    return {
        "@bridge": True,
        "config/nav2.yaml": f"""{node}:
  ros__parameters:
    robot_base_frame: {frame}{mark}
""",
    }


_MARK = "  # ^ WIR026"
GOOD = [
    _example("local_costmap", "r1/base_link"),
    _example("amcl", "/base_link"),
]
BAD = [
    _example("local_costmap", "/base_link", _MARK),
    _example("behavior_server", '"/base_link"', _MARK),
]
