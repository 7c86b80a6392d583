"""Launch files as people write them: each style comes to the words that launch would pass."""

from __future__ import annotations

import pytest

from checker.launch.ros2.graph import display_path
from tests.ros2_launch.conftest import NAME, Read

SHARE = f"$(find-pkg-share {NAME})"
STYLES = {
    "getattr of a module": ("x = [getattr(os.path, 'join')('a', 'b')]", ["a/b"]),
    "getattr of a path": (
        "from pathlib import Path\nx = [getattr(Path('/a/b.urdf'), 'name')]",
        ["b.urdf"],
    ),
    "environment with a default": ("x = [os.environ.get('ROBOT', 'rover')]", ["rover"]),
    "environment without": ("x = [os.environ['ROBOT']]", ["$(env ROBOT)"]),
    "environment in a text": ("x = [f\"{os.environ['ROBOT']}_base\"]", ["$(env ROBOT)_base"]),
    "environment, or a default": ("x = [os.environ.get('ROBOT') or 'rover']", ["rover"]),
    "yaml.dump": ("import yaml\nx = [yaml.dump({'b': 1, 'a': [1, 2]})]", ["a:\n- 1\n- 2\nb: 1\n"]),
    "yaml.safe_dump in a line": (
        "import yaml\nx = [yaml.safe_dump({'b': 1, 'a': 2}, default_flow_style=True)]",
        ["{a: 2, b: 1}\n"],
    ),
    "json.dumps": ("import json\nx = [json.dumps({'a': [1, True]})]", ['{"a": [1, true]}']),
    "json.loads": ('import json\nx = json.loads(\'["a", "b"]\')', ["a", "b"]),
    "json.load": (
        "import json\nwith open(os.path.join(get_package_share_directory("
        f"'{NAME}'), 'config', 'robot.json')) as file:\n    x = [json.load(file)['name']]",
        ["rover"],
    ),
    "dict.update": ("d = {'a': '1'}\nd.update({'a': '2'}, b='3')\nx = [*d.values()]", ["2", "3"]),
    "dict.update of pairs": ("d = {}\nd.update([('a', '1')])\nx = [d['a']]", ["1"]),
    "dict.fromkeys": ("x = list(dict.fromkeys(['a', 'b', 'a']))", ["a", "b"]),
    "numbers in a text": (
        "x = [f'{1.5:.2f}', f'{7:03d}', f'{0.25:>6}']",
        ["1.50", "007", "  0.25"],
    ),
    "text that is formatted": (
        "x = ['{}_{:02d}'.format('a', 3), '%s_%d' % ('b', 4)]",
        ["a_03", "b_4"],
    ),
    "a joined path of a list": (
        f"x = [PathJoinSubstitution([FindPackageShare('{NAME}'), 'urdf', ['r', '.urdf']])]",
        [f"{SHARE}/urdf/r.urdf"],
    ),
    "a joined path of an unpacked list": (
        "parts = ['config', 'a.yaml']\n"
        f"x = [PathJoinSubstitution([FindPackageShare('{NAME}'), *parts])]",
        [f"{SHARE}/config/a.yaml"],
    ),
    "a text of a path": (
        f"from pathlib import Path\nx = [str(Path(get_package_share_directory('{NAME}')) / 'a')]",
        [f"{SHARE}/a"],
    ),
    "os.path.isfile in a choice": (
        f"p = os.path.join(get_package_share_directory('{NAME}'), 'config/robot.json')\n"
        "x = ['there' if os.path.isfile(p) else 'gone']",
        ["there"],
    ),
    "a type that is told": ("x = ['text' if isinstance('a', (str, list)) else 'none']", ["text"]),
    "string methods": ("x = ['a,b'.split(',')[1], ' c '.strip(), 'd'.zfill(3)]", ["b", "c", "00d"]),
    "a lambda with a map": (
        "x = list(map(lambda n: f'/{n}/scan', ['a', 'b']))",
        ["/a/scan", "/b/scan"],
    ),
    "a dictionary of a loop": (
        "d = {k: f'{v:.1f}' for k, v in {'x': 1}.items()}\nx = [d['x']]",
        ["1.0"],
    ),
    "a walrus": ("x = [name] if (name := 'rover') else []", ["rover"]),
    "itertools.product": (
        "import itertools\nx = [a + b for a, b in itertools.product('lr', 'fb')]",
        ["lf", "lb", "rf", "rb"],
    ),
    "math": ("import math\nx = [f'{math.radians(90):.3f}', str(math.pi)[:4]]", ["1.571", "3.14"]),
    "textwrap": ("from textwrap import dedent\nx = [dedent('  a')]", ["a"]),
    "a generator": ("def names():\n    yield 'a'\n    yield 'b'\nx = list(names())", ["a", "b"]),
}
ROBOT = {"config/robot.json": '{"name": "rover"}'}


@pytest.mark.parametrize("style", STYLES)
def test_a_style_comes_to_its_words(style: str, read: Read) -> None:
    statements, expected = STYLES[style]
    end = "return LaunchDescription([Node(package='a', executable='b', arguments=x)])"
    graph = read(f"{statements}\n{end}", others=ROBOT)
    assert [display_path(word.value) for word in graph.nodes[0].arguments] == expected
    assert not graph.unread


def test_what_a_function_performs(read: Read) -> None:
    graph = read(
        """
        def setup(context, *args, **kwargs):
            name = LaunchConfiguration('name').perform(context)
            path = PathJoinSubstitution(['config', [name, '.yaml']]).perform(context)
            values = {'use_sim_time': True}
            values.update({'frame': f'{name}_base'})
            rate = float(context.launch_configurations['rate'])
            words = ['--path', path, f'{rate:.1f}']
            return [Node(package='a', executable='b', arguments=words, parameters=[values])]
        return LaunchDescription([
            DeclareLaunchArgument('name', default_value='rover'),
            DeclareLaunchArgument('rate', default_value='5'),
            OpaqueFunction(function=setup)])
        """
    )
    assert [display_path(word.value) for word in graph.nodes[0].arguments] == [
        *("--path", "config/rover.yaml", "5.0")
    ]
    assert not graph.unread


@pytest.mark.parametrize(
    ("statements", "call"),
    [
        ("import requests\nx = [requests.get('http://a').text]", "requests.get"),
        (
            "import subprocess\nx = [subprocess.check_output(['ls']).decode()]",
            "subprocess.check_output",
        ),
        ("import socket\nx = [socket.gethostname()]", "socket.gethostname"),
        ("import glob\nx = glob.glob('/a/*')", "glob.glob"),
        ("import yaml\nx = [yaml.compose('a')]", "yaml.compose"),
        ("x = [getattr(os, 'no_such', 'a')]", "getattr"),
        ("import yaml\nx = [yaml.dump({}, open('/tmp/a', 'w'))]", "yaml.dump"),
    ],
)
def test_a_call_that_is_not_evaluated_is_named(statements: str, call: str, read: Read) -> None:
    graph = read(
        f"{statements}\nreturn LaunchDescription([Node(package='a', executable='b', arguments=x)])"
    )
    unread = [*graph.unread, *(each for node in graph.nodes for each in node.unread)]
    assert any(call in each.reason for each in unread)
