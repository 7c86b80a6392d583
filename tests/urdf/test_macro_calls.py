"""How a macro is called that no file calls, and what comes of it."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.base.parts import NotAvailable
from checker.engine.subject import Subject
from checker.formats.urdf.description import UrdfDescription
from checker.formats.urdf.macro_calls import MacroCall, minimal_call
from checker.package.inputs import open_input
from checker.rule_testing import write_example

XMLNS = 'xmlns:xacro="http://ros.org/wiki/xacro"'
FILE = "urdf/grip.xacro"
LINK = '<link name="${prefix}palm"/>'


def macro(params: str, body: str = LINK, name: str = "grip") -> str:
    """Return a file that holds one macro."""
    quoted = params.replace('"', "&quot;")
    return (
        f'<robot {XMLNS}>\n<xacro:macro name="{name}" params="{quoted}">{body}</xacro:macro>\n'
        "</robot>\n"
    )


def call(text: str, folder: Path) -> MacroCall | None:
    """Return the call of the macro in a file."""
    package = write_example({"@urdf": True, FILE: text}, folder)
    with open_input(package) as opened:
        return minimal_call(opened.packages[0], FILE)


def described(files: dict[str, object], folder: Path) -> list[UrdfDescription]:
    """Return the robots of a package that macros make."""
    package = write_example({"@urdf": True, **files}, folder)
    with open_input(package) as opened:
        subject = Subject(opened.packages[0])
        found = subject.all(UrdfDescription)
        subject.close()
    assert not isinstance(found, NotAvailable)
    return [description for description in found if description.call is not None]


@pytest.mark.parametrize(
    ("params", "arguments", "blocks"),
    [
        ("", {}, ()),
        ("prefix", {"prefix": ""}, ()),
        ("parent tf_prefix *origin", {"parent": "world", "tf_prefix": ""}, ("origin",)),
        ("a:=1 b:='two words' c:=${d} *mount_origin", {}, ("mount_origin",)),
        ("a:=${b + 1} c:='d'_e", {}, ()),
        ("parent:='' prefix:='' *origin", {"parent": "world"}, ("origin",)),
        ("parent:=base *origin", {}, ("origin",)),
        ('a:="it is" b:=^|c d=e parent_link', {"parent_link": "world"}, ()),
    ],
)
def test_what_a_macro_must_have(
    params: str, arguments: dict[str, str], blocks: tuple[str, ...], tmp_path: Path
) -> None:
    found = call(macro(params), tmp_path)

    assert found is not None
    assert (found.name, dict(found.arguments), found.blocks) == ("grip", arguments, blocks)


@pytest.mark.parametrize(
    "text",
    [
        macro("side"),
        macro("a:=^"),
        macro("*limits"),
        macro("a:='"),
        macro("prefix " * 1000),
        macro("'); drop"),
        macro("", name="a b"),
        macro("", name=""),
        macro("", body="<joint name='j' type='fixed'/>"),
        macro("").replace("</robot>", macro("", name="other").partition("\n")[2]),
        '<sdf version="1.9"/>',
        "<robot",
        "",
    ],
)
def test_what_nobody_can_know(text: str, tmp_path: Path) -> None:
    assert call(text, tmp_path) is None


def test_the_outer_of_two_macros_is_called(tmp_path: Path) -> None:
    inner = macro("side", name="finger").partition("\n")[2].replace("</robot>\n", "")
    text = macro("prefix", body=f'{LINK}<xacro:finger side="l"/>').replace("</robot>", inner)

    found = call(f"{text}</robot>", tmp_path)

    assert found is not None
    assert found.name == "grip"


def test_the_robot_hangs_on_the_world(tmp_path: Path) -> None:
    body = (
        f'{LINK}<joint name="mount" type="fixed"><xacro:insert_block name="origin"/>'
        '<parent link="${parent}"/><child link="${prefix}palm"/></joint>'
    )

    (made,) = described({FILE: macro("parent prefix *origin", body)}, tmp_path)

    assert (made.file, made.robot.name.value) == (FILE, "grip")
    assert {*made.robot.links_by_name} == {"world", "palm"}
    assert made.robot.links_by_name["palm"].span.place().line == 2


@pytest.mark.parametrize(
    "files",
    [
        {FILE: macro("prefix", body='<link name="${of_the_robot}"/>')},
        {
            FILE: macro("prefix"),
            "../acme_cell/package.xml": "<package><name>acme_cell</name></package>",
            "../acme_cell/urdf/cell.xacro": f'<robot name="cell" {XMLNS}>'
            '<xacro:include filename="$(find acme_arm_description)/urdf/grip.xacro"/></robot>',
        },
    ],
)
def test_what_somebody_else_completes_is_left_alone(
    files: dict[str, object], tmp_path: Path
) -> None:
    assert not described(files, tmp_path)
