"""Commands in launch files that do the same as a node, a spawner or an included file."""

from __future__ import annotations

import pytest

from checker.ros.ros2_control.launched import spawner_of
from checker.ros.unread import unread_parts
from tests.ros2_launch.conftest import NAME, Read

_ARM = """<launch>
  <arg name="speed" default="slow"/>
  <node pkg="acme_arm" exec="driver" name="$(var speed)"/>
</launch>
"""
LOAD = "ros2 control load_controller --set-state active"


def _process(*words: str) -> str:
    return f"return LaunchDescription([ExecuteProcess(cmd={[*words]})])"


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        (f"{LOAD} arm", ["arm"]),
        ("ros2 control load_controller arm --set-state start", ["arm"]),
        ("ros2 control load_controller arm", []),
        ("ros2 control set_controller_state arm active", ["arm"]),
        ("ros2 control set_controller_state arm inactive", []),
        ("ros2 control switch_controllers --deactivate a --activate b c --strict", ["b", "c"]),
        (f"{LOAD} -c /left/controller_manager arm > log.txt", ["arm"]),
    ],
)
def test_controllers_that_a_command_starts(read: Read, line: str, expected: list[str]) -> None:
    graph = read(_process(*line.split()))
    spawners = [it for node in graph.nodes_and_spawns if (it := spawner_of(node)) is not None]
    assert [name.value for it in spawners for name in it.names] == expected
    assert [*unread_parts(graph)] == []
    assert all(
        it.options == {"-c": ("/left/controller_manager",)} for it in spawners if ">" in line
    )


def test_a_line_for_a_shell_has_several_commands(read: Read) -> None:
    graph = read(_process("bash", "-c", f"sleep 5; {LOAD} a 2>&1 | tee log && {LOAD} b"))
    (process,) = graph.processes
    assert [node.arguments[0].value for node in process.spawns] == ["a", "b"]
    assert [*unread_parts(graph)] == ["a command may start further nodes"], "tee is not known"


def test_ros2_run_starts_a_node(read: Read) -> None:
    graph = read(_process(*["xterm", "-e", "ros2", "run", "acme_arm", "teleop", "--fast"]))
    (node,) = graph.nodes
    assert (node.package.value, node.executable.value) == ("acme_arm", "teleop")
    assert [word.value for word in node.arguments] == ["--fast"]
    assert not graph.processes


@pytest.mark.parametrize(
    "where", [f"{NAME} arm.launch.xml", f"/share/{NAME}/launch/arm.launch.xml"]
)
def test_ros2_launch_includes_a_file(read: Read, where: str) -> None:
    share = f"get_package_share_directory('{NAME}')"
    words = [repr(word) for word in f"ros2 launch {where} speed:=fast".split()]
    cmd = ", ".join(words).replace(f"'/share/{NAME}/", f"{share} + '/")
    graph = read(
        f"""
        return LaunchDescription([
            PushRosNamespace('left'), SetLaunchConfiguration('speed', 'other'),
            ExecuteProcess(cmd=[{cmd}])])
        """,
        others={"launch/group/arm.launch.xml": _ARM}
        if " " in where
        else {"launch/arm.launch.xml": _ARM},
    )
    (node,) = graph.nodes
    assert node.name is not None
    assert (node.namespace, node.name.value) == ("/", "fast")
    assert [*unread_parts(graph)] == []


def test_ros2_launch_of_another_package(read: Read) -> None:
    graph = read(_process(*["ros2", "launch", "--noninteractive", "acme_maps", "hall.launch.py"]))
    (include,) = graph.includes
    assert include.target.value.endswith("/acme_maps/launch/hall.launch.py")
    assert include.is_unknown
