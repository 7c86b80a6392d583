"""What a hover says of parts, names, files, plugins, xacro and the schema."""

from __future__ import annotations

import math
import random
import re
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, strategies
from markdown_it import MarkdownIt

from checker.base import extras
from checker.base.extras import PHYSICS
from checker.editor.figures import number
from checker.editor.hover.hover import hover_at
from checker.editor.hover.links import principal_moments
from checker.editor.hover.rule_pages import rule_page_markdown
from checker.engine.subject import Subject
from checker.rulebook.discovery import all_rules
from checker.source.text import SourceText
from checker.source.xml import Element, XmlDocument
from support.real_packages import CORPUS, MODERN, judged_files, named_folder, needs
from tests.each import of_each
from tests.editor.subjects import shown, subject_of, text_of, written
from tests.effort import limited

_MODEL = """<?xml version="1.0"?>
<sdf version="1.9">
  <model name="rover" canonical_link="base">
    <link name="base">
      <inertial>
        <pose>0.1 0 0 0 0 0</pose>
        <mass>8</mass>
        <inertia><ixx>0.3</ixx><iyy>0.1</iyy><izz>0.2</izz></inertia>
      </inertial>
      <sensor name="lidar" type="gpu_lidar">
        <update_rate>10</update_rate>
        <topic>scan</topic>
        <lidar>
          <scan>
            <horizontal>
              <samples>361</samples>
              <min_angle>-3.14159265</min_angle>
              <max_angle>3.14159265</max_angle>
            </horizontal>
          </scan>
          <range><min>0.1</min><max>30</max></range>
        </lidar>
      </sensor>
    </link>
    <link name="wheel">
      <pose>0.5 0 -0.1 0 0 1.5707963</pose>
      <inertial><mass>2</mass></inertial>
    </link>
    <joint name="axle" type="revolute">
      <parent>base</parent>
      <child>wheel</child>
      <axis>
        <xyz expressed_in="__model__">0 1 0</xyz>
        <limit><lower>-1.5707963</lower><upper>1.5707963</upper><velocity>2</velocity></limit>
        <dynamics><damping>0.5</damping></dynamics>
      </axis>
    </joint>
    <frame name="mount" attached_to="base"><pose>0 0 1 0 0 0</pose></frame>
    <plugin filename="gz-sim-joint-position-controller-system"
            name="gz::sim::systems::JointPositionController">
      <joint_name>axle</joint_name>
      <p_gain>3</p_gain>
      <colour>red</colour>
    </plugin>
  </model>
</sdf>
"""


@pytest.fixture
def rover(tmp_path: Path) -> Subject:
    return written(tmp_path / "rover", {"model.sdf": _MODEL, "model.config": "<model/>"})


def test_a_link_tells_its_mass_its_place_and_what_hangs_on_it(rover: Subject) -> None:
    text = shown(rover, "model.sdf", '<link name="base"', 13)
    assert "mass: 8 kg of 10 kg" in text
    assert "centre of mass: 0.1 0 0 m" in text
    assert "principal moments 0.1 0.2 0.3 kg·m²" in text
    assert "it is the root" in text
    assert "children: `wheel`" in text
    assert "0 collisions, 0 visuals, 1 sensor" in text


def test_a_link_is_known_wherever_it_is_named(rover: Subject) -> None:
    text = shown(rover, "model.sdf", "<child>wheel", 9)
    assert text.startswith("**link** `wheel`")
    assert "place: 0.5 0 -0.1 m, roll pitch yaw 0 0 90° in `base`" in text
    assert "`base` → `axle` (revolute) → `wheel`" in text
    assert shown(rover, "model.sdf", 'attached_to="base"', 14).startswith("**link** `base`")


def test_a_joint_tells_its_axis_and_its_limits(rover: Subject) -> None:
    text = shown(rover, "model.sdf", '<joint name="axle"', 3)
    assert text.startswith("**revolute joint** `axle`")
    assert "`base` → `wheel`" in text
    assert "0 1 0 in the model's frame" in text
    assert "-1.571 to 1.571 rad (-90° to 90°)" in text
    assert "velocity: 2 rad/s (114.6°/s)" in text
    assert "effort: no limit" in text
    assert "damping 0.5 N·m·s/rad" in text
    assert "plugin `JointPositionController`" in text
    assert shown(rover, "model.sdf", "<joint_name>axle", 13) == text


def test_a_sensor_tells_its_rate_its_rays_and_its_topic(rover: Subject) -> None:
    text = shown(rover, "model.sdf", 'name="lidar"', 7)
    assert "10 Hz" in text
    assert "361 × 1" in text
    assert "-180° to 180°, every 1°" in text
    assert "0.1 to 30 m" in text
    assert "`/scan`" in text


def test_a_plugin_tells_its_parameters_and_which_are_set(rover: Subject) -> None:
    text = shown(rover, "model.sdf", "gz-sim-joint-position-controller-system")
    assert "Gazebo Sim 8 (Harmonic)" in text
    assert "`p_gain` = `3`" in text
    assert "`colour` = `red` (not one of its parameters)" in text
    assert "`i_gain` (double)" in text
    assert "double" in shown(rover, "model.sdf", "<p_gain>", 3)
    assert "reads no parameter" in shown(rover, "model.sdf", "<colour>", 3)


def test_the_schema_tells_of_every_other_element(rover: Subject) -> None:
    text = shown(rover, "model.sdf", "<update_rate>")
    assert "unit: Hz" in text
    assert "type: `double`" in text
    assert "default: `0`" in text
    assert "required: yes" in shown(rover, "model.sdf", 'type="revolute"', 1)


def test_a_frame_and_the_robot_are_known(rover: Subject) -> None:
    assert "0 0 1 m in the model" in shown(rover, "model.sdf", '<frame name="mount"', 2)
    text = shown(rover, "model.sdf", '<model name="rover"', 15)
    assert "mass: 10 kg" in text
    assert "2 links, 1 joint, 1 sensor, 1 plugin" in text


def test_the_hover_covers_the_name_and_nothing_more(rover: Subject) -> None:
    text = text_of(rover, "model.sdf")
    at = text.index("<child>wheel") + len("<child>")
    hover = hover_at(rover, "model.sdf", at + 1)
    assert hover is not None
    assert text[hover.start : hover.end] == "wheel"


def test_a_text_that_is_not_well_formed_says_nothing(tmp_path: Path) -> None:
    subject = written(tmp_path / "rover", {"model.sdf": "<sdf><model"})
    assert hover_at(subject, "model.sdf", 3) is None
    assert hover_at(subject, "absent.sdf", 3) is None


_HOSTILE = "x` ![p](http://example.org/p.png) ```"


@of_each("where", ["link name", "joint type", "plugin name", "sensor type", "macro params"])
def test_no_picture_is_fetched_for_what_a_file_says(tmp_path_factory: Any, where: str) -> None:
    said = dict.fromkeys(("link name", "joint type", "plugin name", "sensor type"), "a")
    said |= {where: _HOSTILE}
    if where == "macro params":
        macro = f"<xacro:macro name='m' params='a:={_HOSTILE.replace(' ', '')}'/><xacro:m/>"
        text = f"<robot name='r' xmlns:xacro='http://www.ros.org/wiki/xacro'>{macro}</robot>"
        path, needle = "urdf/r.urdf.xacro", "<xacro:m/>"
    else:
        sensor = f"<sensor name='s' type='{said['sensor type']}'/>"
        link = f"<link name='{said['link name']}'>{sensor}</link>"
        joint = f"<joint name='j' type='{said['joint type']}'><parent>world</parent></joint>"
        plugin = f"<plugin name='{said['plugin name']}' filename='f'/>"
        text = f"<sdf version='1.9'><model name='m'>{link}{joint}{plugin}</model></sdf>"
        path, needle = "model.sdf", f"<{where.split(maxsplit=1)[0]} name"
    subject = written(tmp_path_factory.mktemp("hostile"), {path: text})
    html = MarkdownIt().render(shown(subject, path, needle, 3))
    assert "<img" not in html
    assert "<a " not in html


def test_markdown_in_names_stays_text(tmp_path: Path) -> None:
    model = '<sdf version="1.9"><model name="m"><link name="a`b [x](y)"/></model></sdf>'
    subject = written(tmp_path / "rover", {"model.sdf": model})
    assert "`` a`b [x](y) ``" in shown(subject, "model.sdf", "<link", 2)


@given(
    strategies.lists(strategies.floats(0.01, 10.0), min_size=3, max_size=3),
    strategies.lists(strategies.floats(-2.0, 2.0), min_size=3, max_size=3),
)
def test_principal_moments_keep_the_invariants(moments: list[float], products: list[float]) -> None:
    ixx, iyy, izz = moments
    ixy, ixz, iyz = products
    a, b, c = principal_moments(ixx, ixy, ixz, iyy, iyz, izz)
    squares = ixx * iyy + iyy * izz + izz * ixx - ixy**2 - ixz**2 - iyz**2
    determinant = (
        ixx * (iyy * izz - iyz**2) - ixy * (ixy * izz - iyz * ixz) + ixz * (ixy * iyz - iyy * ixz)
    )
    assert a <= b <= c
    assert math.isclose(a + b + c, ixx + iyy + izz, rel_tol=1e-9)
    assert math.isclose(a * b + b * c + c * a, squares, rel_tol=1e-6, abs_tol=1e-6)
    assert math.isclose(a * b * c, determinant, rel_tol=1e-5, abs_tol=1e-5)


@of_each("unit", ["${", "$(", "${a ", "a ", "`"])
def test_hostile_values_take_linear_time(tmp_path_factory: Any, unit: str) -> None:
    value = unit * (200_000 // len(unit))
    text = f"<robot name='r' xmlns:xacro='u'><link name='{value}'/></robot>"
    subject = written(tmp_path_factory.mktemp("hostile"), {"urdf/r.urdf.xacro": text})
    with limited(5.0):
        hover_at(subject, "urdf/r.urdf.xacro", text.index(value) + len(value) // 2)


_NUMBER = re.compile(r"(?<=[> ])-?\d+(?:\.\d+)?(?=[< ])")
_ODD = ("nan", "inf", "-inf", "1e999", "", "-0", "1e308", "abc", "0", "1e-320")


@pytest.mark.slow
@given(seed=strategies.integers(0, 10_000))
def test_odd_numbers_make_no_hover_fail(samples: Path, seed: int) -> None:
    dice = random.Random(seed)  # noqa: S311 - what to change
    whole = subject_of(samples / "subtcheck_buggy_sensor_config_1")
    text = _NUMBER.sub(
        lambda it: dice.choice(_ODD) if dice.random() < 0.5 else it[0],
        text_of(whole, "model.sdf"),
    )
    changed = whole.package.with_texts({"model.sdf": SourceText("model.sdf", text)})
    subject = Subject(changed)
    for _ in range(20):
        hover = hover_at(subject, "model.sdf", dice.randrange(len(text)))
        assert hover is None or hover.markdown


@of_each(
    "case",
    [
        *((0.0, "0"), (1 / 3, "0.3333"), (12500, "12500"), (12345.6, "12346"), (1e-5, "1e-05")),
        *((1e20, "1.000e+20"), (-2.5, "-2.5"), (math.inf, "inf")),
    ],
)
def test_numbers_have_four_digits(case: tuple[float, str]) -> None:
    assert number(case[0]) == case[1]


# xacro: what a macro makes, and what an expression comes to.


@pytest.fixture(scope="module")
def husky(samples: Path) -> Subject:
    return subject_of(samples / "husky_description")


def test_a_link_of_a_macro_is_the_first_that_it_makes(husky: Subject) -> None:
    text = shown(husky, "urdf/wheel.xacro", '<link name="', 3)
    assert "**link** `robot_name/front_left_wheel_link`" in text
    assert "mass: 2.6 kg" in text
    assert "3 others" in text


def test_expressions_tell_what_they_come_to(husky: Subject) -> None:
    text = shown(husky, "urdf/wheel.xacro", "${wheel_mass}")
    assert "property `wheel_mass`: `2.6`, in urdf/wheel.xacro:5" in text
    assert "comes to: `2.6`" in text
    assert "default `X1`" in shown(husky, "urdf/husky.urdf.xacro", "$(arg name)")
    assert "parameter `x`: of `husky_wheel`, required" in shown(husky, "urdf/wheel.xacro", "${x}")


def test_a_call_tells_the_parameters_of_its_macro(husky: Subject) -> None:
    text = shown(husky, "urdf/husky.urdf.xacro", "xacro:husky_wheel")
    assert "**macro** `husky_wheel` of urdf/wheel.xacro:7" in text
    assert "`name`: required" in text


def test_names_after_xacro_are_known(husky: Subject) -> None:
    needle = 'child link="${ns}/${name}_wheel_link'
    text = shown(husky, "urdf/wheel.xacro", needle, len(needle) - 2)
    assert text.startswith("**link** `robot_name/front_left_wheel_link`")


def test_short_tags_of_gazebo_tell_what_they_stand_for(husky: Subject) -> None:
    text = shown(husky, "urdf/wheel.xacro", "<mu1>")
    assert "stands for: `link/collision/surface/friction/ode/mu`" in text


def test_a_mesh_tells_its_size_and_its_triangles(husky: Subject) -> None:
    text = shown(husky, "urdf/wheel.xacro", "package://husky_description/meshes/wheel.dae")
    assert "**mesh** `meshes/wheel.dae`" in text
    if PHYSICS.is_installed:
        assert "0.3302 × 0.1143 × 0.3302 m" in text
        assert "triangles: 256" in text
    else:
        assert "pip install 'subt-check" in text


def test_a_file_that_is_missing_is_said_to_be(tmp_path: Path) -> None:
    uri = "model://rover/meshes/none.dae"
    shape = f"<collision name='c'><geometry><mesh><uri>{uri}</uri></mesh></geometry></collision>"
    model = f"<sdf version='1.9'><model name='m'><link name='a'>{shape}</link></model></sdf>"
    subject = written(tmp_path / "rover", {"model.sdf": model})
    assert "does not exist" in shown(subject, "model.sdf", uri)


def test_a_mesh_is_not_read_without_physics(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = extras._is_found
    monkeypatch.setattr(extras, "_is_found", lambda it: it != "numpy" and found(it))
    uri = "meshes/a.stl"
    shape = f"<visual name='c'><geometry><mesh><uri>{uri}</uri></mesh></geometry></visual>"
    model = f"<sdf version='1.9'><model name='m'><link name='a'>{shape}</link></model></sdf>"
    subject = written(tmp_path / "rover", {"model.sdf": model, uri: "solid nobody knows"})
    text = shown(subject, "model.sdf", uri)
    assert "Not read: `pip install 'subt-check[physics]'`." in text
    assert "18 bytes" in text


def test_tags_of_xacro_and_what_they_include_are_told(husky: Subject) -> None:
    path = "urdf/husky.urdf.xacro"
    assert "Declares an argument" in shown(husky, path, "<xacro:arg", 5)
    assert "value: `0.512`" in shown(husky, path, 'name="wheelbase"')
    needle = "$(find husky_description)/urdf/wheel.xacro"
    assert "macros: `husky_wheel`" in shown(husky, path, needle, len(needle) - 2)


def test_an_included_model_tells_what_it_adds(tmp_path: Path) -> None:
    arm = "<sdf version='1.9'><model name='arm'><link name='wrist'/></model></sdf>"
    include = "<include merge='true'><uri>model://arm</uri></include>"
    model = f"<sdf version='1.9'><model name='m'><link name='base'/>{include}</model></sdf>"
    written(tmp_path / "arm", {"model.sdf": arm, "model.config": "<model/>"})
    subject = written(tmp_path / "rover", {"model.sdf": model, "model.config": "<model/>"})
    text = shown(subject, "model.sdf", "model://arm")
    assert "`../arm/model.sdf`" in text
    assert "1 link, 0 joints" in text


def test_hardware_of_ros2_control_is_told(tmp_path: Path) -> None:
    hardware = "<hardware><plugin>mock_components/GenericSystem</plugin></hardware>"
    control = f"<ros2_control name='c' type='system'>{hardware}</ros2_control>"
    subject = written(
        tmp_path / "arm", {"urdf/arm.urdf": f"<robot name='a'><link name='b'/>{control}</robot>"}
    )
    assert "jazzy" in shown(subject, "urdf/arm.urdf", "mock_components/GenericSystem")


def test_urdf_has_its_own_table(husky: Subject) -> None:
    assert "3 numbers" in shown(husky, "urdf/wheel.xacro", "rpy")
    assert "unit: m" in shown(husky, "urdf/wheel.xacro", 'radius="', 3)


# Rule pages.


def test_every_rule_has_a_page_to_hover() -> None:
    for rule in all_rules():
        page = rule_page_markdown(rule)
        assert page.startswith(f"**{rule.id} {rule.name}**: ")
        assert "**Fix:**" in page
        assert "**Source:**" in page
        assert f"/rules/{rule.id}.html)" in page
        assert all(f"`{option}` = " in page for option in rule.options)


# Real packages: every name says something, with the values that the file states.


def _stated(element: Element, *path: str) -> float | None:
    child = element.child(*path)
    try:
        return float(child.value) if child is not None else None
    except ValueError:
        return None


def _check_link(element: Element, text: str) -> None:
    mass = _stated(element, "inertial", "mass")
    if mass is not None:
        assert f"mass: {number(mass)} kg" in text


def _check_joint(element: Element, text: str) -> None:
    parent, child = element.child("parent"), element.child("child")
    assert parent is not None
    assert child is not None
    assert f"`{parent.value}` → `{child.value}`" in text


def _check_sensor(element: Element, text: str) -> None:
    rate = _stated(element, "update_rate")
    assert not rate or f"rate: {number(rate)} Hz" in text
    samples = _stated(element, "ray", "scan", "horizontal", "samples") or _stated(
        element, "lidar", "scan", "horizontal", "samples"
    )
    assert samples is None or f"rays: {number(samples)} ×" in text
    width = _stated(element, "camera", "image", "width")
    assert width is None or f"picture: {number(width)} ×" in text


_CHECKS = {"link": _check_link, "joint": _check_joint, "sensor": _check_sensor}


def _hovered(subject: Subject, path: str, offset: int) -> str:
    hover = hover_at(subject, path, offset)
    assert hover is not None, (path, offset)
    assert hover.start <= offset <= hover.end
    return hover.markdown


def _check_model(subject: Subject, path: str) -> int:
    """Hover over every name of a model; return how many there are."""
    document = subject.package.xml(path)
    assert isinstance(document, XmlDocument)
    seen = 0
    for element in document.elements:
        name = element.attribute("name")
        if element.tag in _CHECKS and name is not None and not _in_plugin(element):
            _CHECKS[element.tag](element, _hovered(subject, path, name.span.start))
        elif element.tag == "plugin" and (file := element.attribute("filename")) is not None:
            assert "**plugin**" in _hovered(subject, path, file.span.start)
        elif element.tag == "uri" and element.parent is not None and element.parent.tag == "mesh":
            assert element.value.rpartition("/")[2] in _hovered(
                subject, path, element.text_span.start
            )
        else:
            continue
        seen += 1
    return seen


def _in_plugin(element: Element) -> bool:
    at = element.parent
    while at is not None and at.tag != "plugin":
        at = at.parent
    return at is not None


MODELS = judged_files(CORPUS, "model.sdf") or [Path()]


@pytest.mark.parametrize("model", MODELS, ids=lambda it: it.parent.name)
class TestCorpus:
    pytestmark = needs(CORPUS)

    def test_every_name_says_something(self, model: Path) -> None:
        assert _check_model(subject_of(model.parent), "model.sdf") > 3


class TestModern:
    pytestmark = needs(MODERN)

    def test_links_and_joints_of_xacro_files_say_something(self) -> None:
        folder = named_folder(MODERN)
        assert folder is not None
        subject = subject_of(folder / "turtlebot3" / "turtlebot3_description")
        seen = 0
        for entry in subject.package.index.with_suffix(".urdf", ".xacro"):
            document = subject.package.xml(entry.path)
            assert isinstance(document, XmlDocument)
            for element in document.root.children:
                name = element.attribute("name")
                if element.tag in ("link", "joint") and name is not None:
                    text = _hovered(subject, entry.path, element.name_span.start + 1)
                    assert f"{element.tag}**" in text
                    seen += 1
        assert seen > 40
