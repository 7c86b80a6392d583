"""YAML texts as controllers: names, joints, gains, and what is none."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.ros.control.controllers import Controller, SimulatorGains
from checker.ros.control.controllers_reader import read_controllers
from checker.source.text import SourceText
from checker.source.yaml import read_yaml

PID = "effort_controllers/JointPositionController"


def read(text: str, namespace: str = "/") -> list[Controller | SimulatorGains]:
    document = read_yaml(SourceText("config/control.yaml", text))
    assert document.root is not None, document.faults
    return list(read_controllers(document.root, namespace, None))


def controllers(text: str, namespace: str = "/") -> dict[str, Controller]:
    return {each.full_name: each for each in read(text, namespace) if isinstance(each, Controller)}


@pytest.mark.parametrize(
    ("text", "namespace", "name"),
    [
        ("arm: {type: a/B}", "/", "/arm"),
        ("arm: {type: a/B}", "/robot", "/robot/arm"),
        ("robot: {left: {arm: {type: a/B}}}", "/", "/robot/left/arm"),
        ("robot/left/arm: {type: a/B}", "/x", "/x/robot/left/arm"),
        ("/robot: {arm: {type: a/B}}", "/x", "/robot/arm"),
        ("type: a/B", "/robot/arm", "/robot/arm"),
    ],
)
def test_keys_make_names(text: str, namespace: str, name: str) -> None:
    (found,) = controllers(text, namespace)
    assert found == name


@pytest.mark.parametrize(
    "text",
    [
        "planner: {type: geometric}",
        "arm: {type: [a/B]}",
        "arm: [a/B]",
        "arm: {type: a/B/C}",
        "joint_names: {joint: shoulder}",
        "5",
        "~",
        "[1, 2]",
        "{? [a, b] : {type: 5}}",
    ],
)
def test_what_is_no_controller(text: str) -> None:
    assert not read(text)


def test_what_stands_within_a_controller_is_its_own_but_for_absolute_names() -> None:
    text = """
arm:
  type: a/B
  inner: {type: c/D}
  /other: {type: e/F}
"""
    assert set(controllers(text)) == {"/arm", "/other"}


def test_a_controller_without_type() -> None:
    (arm,) = controllers("arm: {joint: shoulder, pid: {p: 1}}").values()
    assert arm.type is None
    assert (arm.family, arm.kind) == ("", "")


def test_joints() -> None:
    text = """
one: {type: a/B, joint: shoulder}
more: {type: a/B, joints: [shoulder, elbow, 5]}
drive: {type: a/B, left_wheel: [l1, l2], right_wheel: r1}
unknown: {type: a/B, joint: $(arg joint)}
"""
    found = controllers(text)
    assert [joint.value for joint in found["/one"].joints] == ["shoulder"]
    assert [joint.value for joint in found["/more"].joints] == ["shoulder", "elbow"]
    assert [joint.value for joint in found["/drive"].joints] == ["l1", "l2", "r1"]
    assert not found["/unknown"].joints
    assert found["/one"].joints[0].span.text == "shoulder"


@pytest.mark.parametrize(
    "gains",
    ["pid: {p: 3}", "gains: {shoulder: {p: 3}}", "shoulder: {pid: {p: 3}}"],
)
def test_gains_stand_in_three_places(gains: str) -> None:
    (arm,) = controllers(f"arm: {{type: {PID}, joint: shoulder, {gains}}}").values()
    assert arm.gains["shoulder"]["p"].value == 3.0


def test_gains_that_are_no_numbers() -> None:
    text = f"arm: {{type: {PID}, joint: j, pid: {{p: 1e3, i: true, d: $(arg d)}}}}"
    gains = controllers(text)["/arm"].gains["j"]
    assert gains["p"].value is None
    assert gains["p"].text == "1e3"
    assert gains["i"].value is None
    assert math.isnan(gains["d"].value or 0.0)


def test_huge_gains() -> None:
    gains = controllers(f"arm: {{type: a/B, joint: j, pid: {{p: {'9' * 400}}}}}")["/arm"].gains
    assert gains["j"]["p"].value == math.inf


def test_gains_of_the_simulator() -> None:
    text = "robot: {gazebo_ros_control: {pid_gains: {wheel: {p: 100.0, d: -1}}}}"
    (gains,) = read(text)
    assert isinstance(gains, SimulatorGains)
    assert gains.joint == "wheel"
    assert gains.gains["d"].value == -1.0


def test_aliases_share_gains() -> None:
    text = f"""
a: {{type: {PID}, joint: j, pid: &gains {{p: 2.0}}}}
b: {{type: {PID}, joint: k, pid: *gains}}
c: {{<<: {{type: {PID}, joint: l}}, pid: *gains}}
"""
    assert set(controllers(text)) == {"/a", "/b", "/c"}
    assert controllers(text)["/c"].gains["l"]["p"].value == 2.0


def test_aliases_do_not_explode() -> None:
    text = "a0: &a0 {type: a/B}\n" + "".join(
        f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 9)}]\n" for n in range(1, 12)
    )
    document = read_yaml(SourceText("config/bomb.yaml", text))
    assert document.root is None
    assert "too many" in document.faults[0].message


WORDS = st.sampled_from(["type", "joint", "joints", "pid", "gains", "p", "a/B", "j", "/x", "~", ""])
VALUES = st.recursive(
    st.one_of(st.none(), st.booleans(), st.integers(), st.floats(), WORDS),
    lambda inner: st.one_of(st.lists(inner, max_size=4), st.dictionaries(WORDS, inner, max_size=5)),
    max_leaves=25,
)


@given(VALUES, st.sampled_from(["/", "/robot", "/a/b"]))
def test_any_text_is_read(value: object, namespace: str) -> None:
    import yaml

    document = read_yaml(SourceText("c.yaml", yaml.safe_dump(value)))
    if document.root is not None:
        for each in read_controllers(document.root, namespace, None):
            if isinstance(each, Controller):
                assert each.full_name.startswith("/")
                assert each.namespace.startswith("/")
