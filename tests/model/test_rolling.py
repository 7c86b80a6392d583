"""What a robot rolls on, which wheels are off the level of the others, and what overlaps."""

from __future__ import annotations

from dataclasses import dataclass

import pytest
from msgspec.structs import replace

from checker.model.geometry.interpenetration import interpenetrations
from checker.model.locomotion.rolling_parts import carriers, on_one_axle, rolling_parts
from checker.model.locomotion.wheel_positions import uneven_wheels
from checker.model.mesh import Mesh, MeshFault, MeshTrouble
from checker.model.robot import Robot
from checker.source.text import Located
from tests.model.robots import sdf

BASE = '<link name="base"/>'


def wheel(name: str, x: float, y: float, z: float = 0, parent: str = "base") -> str:
    return f"""
<link name="{name}"><pose>{x} {y} {z} 0 0 0</pose>
  <collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
</link>
<joint name="{name}_axle" type="revolute">
  <parent>{parent}</parent><child>{name}</child><axis><xyz>0 1 0</xyz></axis>
</joint>
"""


def driven(*names: str) -> str:
    joints = "".join(f"<left_joint>{name}_axle</left_joint>" for name in names)
    return f'<plugin name="ignition::gazebo::systems::DiffDrive" filename="p">{joints}</plugin>'


def rover(**heights: float) -> Robot:
    """A rover whose wheels `fl`, `mr`, … stand in front, middle or rear, left or right."""
    at = {"f": 0.4, "m": 0.0, "r": -0.4}
    side = {"l": 0.3, "r": -0.3, "c": 0.0}
    wheels = [wheel(n, at[n[0]], side[n[1]], z) for n, z in heights.items()]
    return sdf(BASE + "".join(wheels) + driven(*heights))


class TestRollingParts:
    def test_links_called_wheels_count_where_they_turn(self) -> None:
        spare = "<link name='spare_wheel'><collision name='c'><geometry><box/></geometry>"
        spare += "</collision></link>"
        robot = sdf(BASE + wheel("fl", 0, 0) + driven("fl") + wheel("caster_wheel", 1, 0) + spare)
        assert [part.link.name.value for part in rolling_parts(robot)] == ["fl", "caster_wheel"]

    @pytest.mark.parametrize(
        ("type_", "suspended"), [("fixed", False), ("prismatic", True), ("revolute", True)]
    )
    def test_what_hangs_on_a_joint_that_gives(self, type_: str, suspended: bool) -> None:
        arm = f"""<link name="arm"/><link name="hub"/>
<joint name="swing" type="{type_}"><parent>base</parent><child>arm</child></joint>
<joint name="bolt" type="fixed"><parent>arm</parent><child>hub</child></joint>"""
        (part,) = rolling_parts(sdf(BASE + arm + wheel("w", 0, 0, parent="hub") + driven("w")))
        assert part.suspended is suspended

    def test_carriers_are_all_links_above_loops_included(self) -> None:
        loop = "<joint name='l' type='fixed'><parent>fl</parent><child>base</child></joint>"
        robot = sdf(BASE + wheel("fl", 0, 0) + driven("fl") + loop + "<link name='arm'/>")
        assert carriers(robot, rolling_parts(robot)) == {"base", "fl"}

    def test_one_axle(self) -> None:
        assert on_one_axle(rolling_parts(rover(fl=0, fr=0)))
        assert not on_one_axle(rolling_parts(rover(fl=0, fr=0, rc=0)))


class TestLevel:
    @pytest.mark.parametrize(
        ("robot", "expected"),
        [
            (rover(fl=0, fr=0, rl=0, rr=0), {}),
            (rover(fl=0.05, fr=0, rl=0, rr=0), {"fl": 0.05}),
            (rover(fl=-0.05, fr=0, rl=0, rr=0), {"fl": -0.05}),
            (rover(fl=0.05, fr=0.05, rl=0, rr=0), {}),
            (rover(fl=0.05, fr=0.05, ml=0, mr=0, rl=0.01, rr=0), {"rl": 0.01, "rr": -0.01}),
            (rover(fl=0.03, fr=0, rl=0.03, rr=0), {"fl": 0.03, "rl": 0.03}),
            (rover(fl=0.05, fr=0), {"fl": 0.05}),
            (rover(fl=0, fr=0, rc=0.05), {}),
            (rover(fl=0.0), {}),
            (rover(fl=1e308, fr=-1e308, rl=0, rr=0), None),
        ],
    )
    def test_uneven_wheels(self, robot: Robot, expected: dict[str, float] | None) -> None:
        found = {f.part.link.name.value: f.off for f in uneven_wheels(robot, 0.005)}
        assert expected is None or found == pytest.approx(expected)


@dataclass(frozen=True)
class OneMesh:
    mesh: Mesh

    def load(self, uri: Located[str]) -> Mesh | MeshFault:
        known = uri.value == self.mesh.path
        return self.mesh if known else MeshFault(MeshTrouble.MISSING, "is missing")


def body(name: str, x: float, shape: str = "<box><size>1 1 1</size></box>") -> str:
    return f"""<link name="{name}"><pose>{x} 0 0 0 0 0</pose>
<collision name="c"><geometry>{shape}</geometry></collision></link>"""


def tie(parent: str, child: str, type_: str = "revolute") -> str:
    return f"""<joint name="{parent}_{child}" type="{type_}">
<parent>{parent}</parent><child>{child}</child></joint>"""


class TestInterpenetration:
    @pytest.mark.parametrize(
        ("ties", "count"),
        [
            ("", 1),
            (tie("a", "b"), 0),
            (tie("a", "k") + tie("k", "b"), 0),
            (tie("a", "solid") + tie("solid", "b"), 1),
            (tie("a", "solid", "fixed") + tie("solid", "b", "fixed"), 0),
            (tie("a", "solid", "fixed") + tie("solid", "b"), 0),
        ],
    )
    def test_what_ties_excuse(self, ties: str, count: int) -> None:
        others = "<link name='k'/>" + body("solid", 50)
        robot = sdf(body("a", 0) + body("b", 0.9) + others + ties)
        found = list(interpenetrations(robot, 0.01))
        assert [each.depth for each in found] == pytest.approx([0.1] * count)

    @pytest.mark.parametrize(("volume", "count"), [(1.0, 1), (0.3, 0), (None, 0), (-1.0, 0)])
    def test_a_mesh_counts_where_it_fills_its_hull(self, volume: float, count: int) -> None:
        low, high = (-0.5, -0.5, -0.5), (0.5, 0.5, 0.5)
        mesh = Mesh("m.stl", "stl", 12, low, high, volume=volume, hull_volume=1.0)
        shape = "<mesh><uri>m.stl</uri></mesh>"
        robot = replace(sdf(body("a", 0, shape) + body("b", 0.9)), meshes=OneMesh(mesh))
        assert len(list(interpenetrations(robot, 0.01))) == count

    def test_rows_of_wheels_that_stand_for_a_track(self) -> None:
        robot = sdf(BASE + wheel("w1", 0, 0) + wheel("w2", 0.1, 0) + driven("w1", "w2"))
        assert not list(interpenetrations(robot, 0.01))
