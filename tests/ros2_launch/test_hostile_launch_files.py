"""Hostile launch files end soon, need little memory, and reach nothing outside."""

from __future__ import annotations

import pytest

from checker.launch.ros2.graph import LaunchFaultKind
from tests.effort import limited
from tests.ros2_launch.conftest import Read

SECONDS = 6.0
_NODE = "return LaunchDescription([Node(package='p', executable='e', arguments=[x])])"

LIMITED = (
    "x = 'a'\nfor i in range(60):\n    x = x + x",
    "x = 'a' * 10 ** 9",
    "x = ['a'] * 10 ** 9",
    "x = 9 ** 9 ** 9 ** 9",
    "x = 1 << 10 ** 12",
    "x = [y for a in range(4000) for b in range(4000) for y in 'ab']",
    "x = 0\nwhile True:\n    x = x + 1",
    "def f(n):\n    return f(n + 1)\nx = f(0)",
    "def f(n):\n    return [f(n - 1), f(n - 1)] if n else []\nx = f(40)",
    "x = '%1000000000d' % 1",
    "x = f'{1:1000000000}'",
    "x = 'a'.ljust(10 ** 9)",
    "x = ('a' * 90000).replace('a', 'a' * 90000)",
    "x = {}\nfor i in range(10 ** 8):\n    x[i] = i",
    "x = []\nfor i in range(40):\n    x = [x, x]\nx = [str(x)]",
    "x = (1,)\nfor i in range(60):\n    x = (x, x)\nx = {x: 1}",
    "x = (1,)\nfor i in range(60):\n    x = (x, x)\nx = x == (x, x)",
    "x = []\nx.append(x)\nx = str(x)",
    "d = {}\nd['d'] = d\nx = str(d)",
    "x = " + "-" * 5_000 + "1",
    "x = " + "(" * 5_000 + "1" + ")" * 5_000,
    "x = " + " + ".join(["'a'"] * 20_000),
    "x = " + "[" * 90 + "]" * 90,
    "x = ''.join(['a' * 1000] * 4000 + ['b' * 1000] * 4000)",
    "x = 'a,' * 90000\nx = x.split(',')",
)
REFUSED = (
    "x = __import__('os').system('touch /tmp/owned')",
    "x = ().__class__.__bases__[0].__subclasses__()",
    "x = eval('1')",
    "x = exec('1')",
    "x = open('/etc/passwd').read()",
    "import subprocess\nx = subprocess.check_output(['id'])",
    "x = '{0.__class__}'.format('a')",
    "x = getattr('a', '__class__')",
    "x = (lambda: 0).__globals__",
    "x = PythonExpression(['__import__(\"os\").getcwd()'])",
    "import os\nx = os.listdir('/')",
    "from pathlib import Path\nx = Path('/etc/passwd').read_text()",
    "from pathlib import Path\nx = Path('../../../etc/passwd').read_text()",
    "import yaml\nx = yaml.safe_load(open('/etc/passwd'))",
)


@pytest.mark.parametrize("statements", LIMITED, ids=lambda text: text[:40])
def test_what_takes_too_much_ends_soon(read: Read, statements: str) -> None:
    with limited(SECONDS):
        graph = read(f"{statements}\n{_NODE}")
    assert graph.unread or graph.faults
    assert sum(len(word.value) for node in graph.nodes for word in node.arguments) < 1_000_000


@pytest.mark.parametrize("statements", REFUSED, ids=lambda text: text[:40])
def test_what_reaches_outside_is_not_known(read: Read, statements: str) -> None:
    graph = read(f"{statements}\n{_NODE}")
    (word,) = graph.nodes[0].arguments
    assert "$(" in word.value
    assert "root" not in word.value


@pytest.mark.slow
@pytest.mark.parametrize(
    "text",
    [
        "<launch>" + "<group>" * 200 + "</group>" * 200 + "</launch>",
        f'<launch><let name="a" value="{"$(var " * 5_000}"/></launch>',
        '<launch><let name="a" value="$(eval \'9 ** 9 ** 9\')"/>'
        '<node pkg="$(var a)" exec="e"/></launch>',
        '<launch><include file="$(dirname)/a.launch.xml"/></launch>',
        f'<launch><node pkg="p" exec="e" args="{"a " * 100_000}"/></launch>',
        '<launch><let name="a" value="aaaaaaaaaa"/>'
        + '<let name="a" value="$(var a)$(var a)$(var a)$(var a)"/>' * 20
        + '<node pkg="$(var a)" exec="e"/></launch>',
        "<launch><node></launch>",
        "<launch><node/><param/><include/><let/><arg/><group if='x'/></launch>",
    ],
    ids=lambda text: text[:60],
)
def test_hostile_xml_ends_soon(read: Read, text: str) -> None:
    with limited(SECONDS):
        graph = read(text, "launch/a.launch.xml")
    assert graph.unread or graph.faults


def test_many_includes_are_bounded(read: Read) -> None:
    include = '<include file="$(dirname)/{}.launch.xml"/>'
    others = {
        f"launch/{number}.launch.xml": f"<launch>{include.format(number + 1) * 2}</launch>"
        for number in range(30)
    }
    with limited(SECONDS):
        graph = read("<launch>" + include.format(0) + "</launch>", "launch/a.launch.xml", others)
    assert len(graph.includes) < 1_000
    assert graph.faults[-1].kind is LaunchFaultKind.LIMIT


def test_wide_includes_are_bounded(read: Read) -> None:
    include = '<include file="$(dirname)/b.launch.xml"/>'
    others = {"launch/b.launch.xml": "<launch/>"}
    graph = read(f"<launch>{include * 200}</launch>", "launch/a.launch.xml", others)
    assert "more than 60 files are included" in {include.reason for include in graph.includes}


def test_a_syntax_error_is_a_fault_at_its_line(read: Read) -> None:
    graph = read("x = 1\nx = (\nreturn 2")
    (fault,) = graph.faults
    assert fault.kind is LaunchFaultKind.SYNTAX
    assert fault.span.line > 1
