"""A place in an expanded document is the place that a person wrote."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from checker.base.cache import NO_CACHE
from checker.formats.xacro.expanded import expanded_document
from checker.formats.xacro.files import Gathered
from checker.model.components import Link
from checker.model.robot import Robot
from checker.robots.urdf_files import UrdfFiles
from checker.source.text import SourceText, Span
from checker.source.xml import XmlDocument, parse_xml
from tests.effort import examples
from tests.urdf.conftest import NAME, Describe, robot

FILE = f"{NAME}/urdf/acme.urdf.xacro"
WHEEL = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:property name="mass" value="2"/>
<xacro:macro name="wheel" params="side">
  <link name="${side}_wheel">
    <inertial>
      <mass value="${mass}"/>
      <origin xyz="0 0 1"/>
    </inertial>
  </link>
</xacro:macro>
</robot>
"""


def link(describe: Describe, name: str, body: str) -> Link:
    parts = {f"{NAME}/urdf/wheel.xacro": WHEEL}
    robots = describe({FILE: robot(body), **parts}).all(Robot)
    assert isinstance(robots, tuple)
    return robots[0].links_by_name[name]


def shown(span: Span) -> tuple[str, int, str]:
    place = span.place()
    end = None if place.end_line != place.line else place.end_column - 1
    return place.file, place.line, place.snippet[place.column - 1 : end]


INCLUDE = '<xacro:include filename="wheel.xacro"/>\n<xacro:wheel side="left"/>'


def test_a_macro_of_another_file(describe: Describe) -> None:
    wheel = link(describe, "left_wheel", INCLUDE)
    assert shown(wheel.span) == ("urdf/wheel.xacro", 4, '<link name="${side}_wheel">')
    assert shown(wheel.name.span) == ("urdf/wheel.xacro", 4, "${side}_wheel")


def test_an_expression_and_a_number(describe: Describe) -> None:
    inertial = link(describe, "left_wheel", INCLUDE).inertial
    assert inertial is not None
    assert inertial.mass.value == 2
    assert shown(inertial.mass.span) == ("urdf/wheel.xacro", 6, "${mass}")
    assert shown(inertial.pose.numbers[2].span) == ("urdf/wheel.xacro", 7, "1")


def test_text_and_whole_elements(describe: Describe) -> None:
    body = """<link name="a"/>
<gazebo reference="a">
  <sensor name="s" type="imu">
    <update_rate>50</update_rate>
  </sensor>
</gazebo>"""
    sensor = link(describe, "a", body).sensors[0]
    assert shown(sensor.update_rate.span) == ("urdf/acme.urdf.xacro", 5, "50")
    place = sensor.element.whole_span.place()
    assert (place.line, place.end_line) == (4, 6)


def test_a_fault_of_xacro_stands_at_its_element(describe: Describe) -> None:
    subject = describe(
        {FILE: robot(f'{INCLUDE}\n<link name="a"/>\n<link name="${{b}}"/>')}
        | {f"{NAME}/urdf/wheel.xacro": WHEEL}
    )
    (fault,) = subject.one(UrdfFiles).faults
    assert shown(fault.span) == ("urdf/acme.urdf.xacro", 5, '<link name="${b}"/>')
    assert "'b' is not defined" in fault.message


def test_a_fault_inside_a_macro_names_the_macro(describe: Describe) -> None:
    broken = WHEEL.replace("${mass}", "${maas}")
    subject = describe({FILE: robot(INCLUDE), f"{NAME}/urdf/wheel.xacro": broken})
    (fault,) = subject.one(UrdfFiles).faults
    assert shown(fault.span)[:2] == ("urdf/wheel.xacro", 6)
    assert "in the macro wheel" in fault.message


_names = st.sampled_from(["a", "b", "link"])
_texts = st.sampled_from(["", " ", "x", " 1 2 ", "é", "&amp;"])
_xml = st.recursive(
    st.builds(lambda name, text: f'<{name} k="{text}">{text}</{name}>', _names, _texts),
    lambda inner: st.builds(
        lambda name, parts, text: f"<{name}>{text}{''.join(parts)}\n</{name}>",
        _names,
        st.lists(inner, max_size=3),
        _texts,
    ),
    max_leaves=12,
)


@settings(max_examples=examples(60))
@given(_xml)
def test_what_xacro_leaves_alone_keeps_every_place(text: str) -> None:
    source = SourceText("a.xacro", text)
    document = parse_xml(source)
    assert isinstance(document, XmlDocument)
    gathered = Gathered(None)  # type: ignore[arg-type]
    gathered.sources["a"], gathered.documents["a"] = source, document
    origins = [(0, number) for number in range(len(document.elements))]
    expanded = expanded_document({"xml": text, "files": ["a"], "origins": origins}, gathered, "a")
    assert expanded is not None
    for one, other in zip(document.elements, expanded.elements, strict=True):
        assert one.span.place() == other.span.place()
        assert one.whole_span.place() == other.whole_span.place()
        if one.text.stated:
            assert one.text.span.place() == other.text.span.place()
        if (written := one.attribute("k")) is not None and written.value:
            assert written.span.place() == other.attribute("k").span.place()  # type: ignore[union-attr]
    assert NO_CACHE.folder is None
