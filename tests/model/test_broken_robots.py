"""A sound robot is clean; broken in one way, it gets the finding for that and no other."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from checker.engine.judge import Judge
from checker.engine.run import run_rules
from checker.engine.subject import Subject
from checker.package.inputs import open_input
from checker.report.report import Cause
from checker.rule_testing import write_example
from checker.rulebook.discovery import all_rules
from checker.rulebook.example_files import NAME
from checker.rulebook.profiles import profile
from checker.settings import Settings
from tests.effort import examples

_OF_ARMS = "KIN021"
"""Some of the robots are arms by chance, on a base that cannot carry them."""
RULES = [it for it in all_rules() if it.group in ("SDF", "KIN") and it.id != _OF_ARMS]
BASE = "base_link"
LINK = """<link name="{name}">{extra}
<pose{frame}>{x} {y} {z} 0.1 -0.2 0.3</pose>
<inertial><mass>2.5</mass><inertia><ixx>0.1</ixx><ixy>0</ixy><ixz>0</ixz><iyy>0.1</iyy><iyz>0</iyz><izz>0.1</izz></inertia></inertial>
<collision name="c"><geometry><box><size>0.5 0.6 0.7</size></box></geometry></collision>
</link>
"""


@dataclass(frozen=True)
class Link:
    name: str
    at: tuple[float, float, float]
    extra: str = ""
    frame: str = ""

    def text(self) -> str:
        x, y, z = self.at
        frame = f' frame="{self.frame}"' if self.frame else ""
        return LINK.format(name=self.name, x=x, y=y, z=z, extra=self.extra, frame=frame)


@dataclass(frozen=True)
class Joint:
    name: str
    parent: str
    child: str
    type: str = "fixed"
    axis: str = ""
    lower: float = -1.0
    upper: float = 1.0
    limit: str = "<effort>20</effort><velocity>3</velocity>"
    more: str = ""

    def text(self) -> str:
        bounds = f"<lower>{self.lower}</lower><upper>{self.upper}</upper>" if self.limit else ""
        inside = f"<xyz>{self.axis}</xyz><limit>{bounds}{self.limit}</limit>{self.more}"
        return (
            f'<joint name="{self.name}" type="{self.type}">\n'
            f"<parent>{self.parent}</parent>\n<child>{self.child}</child>\n"
            f"{f'<axis>{inside}</axis>' if self.axis else ''}\n</joint>\n"
        )


@dataclass(frozen=True)
class Robot:
    links: tuple[Link, ...]
    joints: tuple[Joint, ...]
    order: tuple[int, ...] = field(default=())

    def text(self) -> str:
        parts = [part.text() for part in (*self.links, *self.joints)]
        # What a mutation adds comes last.
        order = [*(i for i in self.order if i < len(parts)), *range(len(self.order), len(parts))]
        inside = "".join(parts[i] for i in order)
        return f'<sdf version="1.6">\n<model name="{NAME}">\n{inside}</model>\n</sdf>\n'

    def with_joint(self, index: int, **changes: object) -> Robot:
        joints = list(self.joints)
        joints[index] = replace(joints[index], **changes)  # type: ignore[arg-type]  # by name
        return replace(self, joints=tuple(joints))

    def with_link(self, index: int, **changes: object) -> Robot:
        links = list(self.links)
        links[index] = replace(links[index], **changes)  # type: ignore[arg-type]  # by name
        return replace(self, links=tuple(links))

    def below(self, name: str) -> set[str]:
        """Return a link and all that hang on it; joints come from the base outwards."""
        found = {name}
        for joint in self.joints:
            if joint.parent in found:
                found.add(joint.child)
        return found


@st.composite
def robots(draw: st.DrawFn) -> Robot:
    """Draw a tree of 3 to 9 links; the first joint moves, the others may."""
    count = draw(st.integers(3, 9))
    near = st.integers(-3, 3).map(lambda tenths: tenths / 10)
    links, joints = [Link(BASE, (0.0, 0.0, 0.0))], []
    for i in range(1, count):
        parent = links[draw(st.integers(0, i - 1))]
        x, y, z = (along + draw(near) for along in parent.at)
        # Names as unlike one another as can be, so that none is taken for another misspelt.
        name = f"{chr(96 + i) * 6}_{i}"
        links.append(Link(name, (round(x, 3), round(y, 3), round(z, 3))))
        type = "revolute" if i == 1 else draw(st.sampled_from(["revolute", "prismatic", "fixed"]))
        axis = draw(st.sampled_from(["1 0 0", "0 -1 0", "0.6 0 0.8"])) if type != "fixed" else ""
        joints.append(Joint(f"{name}_joint", parent.name, name, type, axis))
    order = draw(st.permutations(range(2 * count - 1)))
    return Robot(tuple(links), tuple(joints), tuple(order))


Mutation = Callable[[Robot, st.DrawFn], Robot]


def on_joint(**changes: object) -> Mutation:
    """Change the first joint, which moves."""
    return lambda robot, _: robot.with_joint(0, **changes)


def on_link(**changes: object) -> Mutation:
    """Change any link."""

    def mutate(robot: Robot, draw: st.DrawFn) -> Robot:
        return robot.with_link(draw(st.integers(0, len(robot.links) - 1)), **changes)

    return mutate


def misspelt_child(robot: Robot, draw: st.DrawFn) -> Robot:
    index = draw(st.integers(0, len(robot.joints) - 1))
    return robot.with_joint(index, child=robot.joints[index].child + "x")


def unknown_parent(robot: Robot, draw: st.DrawFn) -> Robot:
    return robot.with_joint(draw(st.integers(0, len(robot.joints) - 1)), parent="Nowhere")


def second_link_of_a_name(robot: Robot, draw: st.DrawFn) -> Robot:
    return replace(robot, links=(*robot.links, draw(st.sampled_from(robot.links))))


def second_joint_of_a_name(robot: Robot, _: st.DrawFn) -> Robot:
    return robot.with_joint(1, name=robot.joints[0].name)


def loop(robot: Robot, draw: st.DrawFn) -> Robot:
    """Hang the first link below the base on a link that hangs on it."""
    first = robot.joints[0].child
    others = sorted(robot.below(first) - {first})
    if not others:
        return robot.with_joint(0, parent=first)
    return robot.with_joint(0, parent=draw(st.sampled_from(others)))


def second_parent(robot: Robot, draw: st.DrawFn) -> Robot:
    """Hang the last link, below which there is none, on another link as well."""
    last = robot.joints[-1]
    parent = draw(st.sampled_from([each.name for each in robot.links if each.name != last.child]))
    return replace(robot, joints=(*robot.joints, Joint("extra", parent, last.child)))


def itself(robot: Robot, draw: st.DrawFn) -> Robot:
    name = draw(st.sampled_from(robot.links)).name
    return replace(robot, joints=(*robot.joints, Joint("extra", name, name)))


def untied(robot: Robot, draw: st.DrawFn) -> Robot:
    index = draw(st.integers(0, len(robot.joints) - 1))
    return replace(robot, joints=(*robot.joints[:index], *robot.joints[index + 1 :]), order=())


def another_base(robot: Robot, _: st.DrawFn) -> Robot:
    joints = tuple(
        replace(joint, parent="chassis") if joint.parent == BASE else joint
        for joint in robot.joints
    )
    return replace(robot.with_link(0, name="chassis"), joints=joints)


def far_away(robot: Robot, _: st.DrawFn) -> Robot:
    return robot.with_link(len(robot.links) - 1, at=(40.0, 0.0, 0.0))


def reserved_name(robot: Robot, _: st.DrawFn) -> Robot:
    last = len(robot.joints) - 1
    return robot.with_joint(last, child="__tip__").with_link(last + 1, name="__tip__")


MUTATIONS: dict[str, tuple[str, Mutation, set[str]]] = {
    "child misspelt": ("KIN001", misspelt_child, set()),
    "parent unknown": ("KIN001", unknown_parent, set()),
    "child missing": ("KIN001", on_joint(child=""), set()),
    "link hangs on itself": ("KIN002", itself, set()),
    "second parent": ("KIN002", second_parent, set()),
    "loop": ("KIN002", loop, set()),
    "link untied": ("KIN003", untied, set()),
    "axis of zeros": ("KIN004", on_joint(axis="0 0 0"), set()),
    "axis too long": ("KIN004", on_joint(axis="0 2 0"), set()),
    "axis missing": ("KIN004", on_joint(axis=""), {"SDF005"}),
    "limits swapped": ("KIN005", on_joint(lower=1.0, upper=-1.0), set()),
    "limits missing": ("KIN006", on_joint(limit=""), set()),
    "effort absurd": ("KIN007", on_joint(limit="<effort>1e9</effort>"), set()),
    "type unknown": ("KIN008", on_joint(type="hinge"), set()),
    "type not simulated": ("KIN008", on_joint(type="continuous"), set()),
    "limits equal": ("KIN009", on_joint(lower=0.0, upper=0.0), set()),
    "frame unknown": ("KIN010", on_link(frame="nowhere"), {"SDF014"}),
    "no base_link": ("KIN011", another_base, set()),
    "part far away": ("KIN013", far_away, set()),
    "mimic of nothing": (
        "KIN014",
        on_joint(more='<mimic joint="nobody"/>'),
        {"SDF003", "SDF008"},
    ),
    "damping negative": (
        "KIN015",
        on_joint(more="<dynamics><damping>-1</damping></dynamics>"),
        set(),
    ),
    "gravity off": ("KIN016", on_link(extra="<gravity>0</gravity>"), set()),
    "kinematic": ("KIN016", on_link(extra="<kinematic>true</kinematic>"), set()),
    "start outside limits": ("KIN017", on_joint(lower=0.5), set()),
    "name of another link": ("SDF009", second_link_of_a_name, set()),
    "name of another joint": ("SDF009", second_joint_of_a_name, set()),
    "reserved name": ("SDF009", reserved_name, set()),
    "element misspelt": ("SDF003", on_link(extra="<gravty>1</gravty>"), set()),
}
"""What breaks a robot: the rule that says so, how, and rules that may say it as well."""


def reported(robot: Robot) -> list[str]:
    """Return the ids of the findings; a rule that crashed counts as one."""
    with tempfile.TemporaryDirectory() as folder:
        package = write_example({"model.sdf": robot.text()}, Path(folder))
        with open_input(package) as opened:
            subject = Subject(opened.packages[0])
            outcome = run_rules(RULES, subject, Judge(profile("subt"), Settings()))
    crashed = [each.rule + "!" for each in outcome.not_checked if each.cause is Cause.CRASHED]
    return crashed + [finding.rule for finding in outcome.findings]


@settings(max_examples=examples(40))
@given(robots())
def test_a_sound_robot_is_clean(robot: Robot) -> None:
    assert reported(robot) == []


@pytest.mark.parametrize("name", MUTATIONS)
@settings(max_examples=examples(12))
@given(data=st.data())
def test_a_broken_robot_gets_its_finding(name: str, data: st.DataObject) -> None:
    rule, mutate, also = MUTATIONS[name]
    broken = mutate(data.draw(robots()), data.draw)
    found = reported(broken)
    assert [each for each in found if each not in also] == [rule]
