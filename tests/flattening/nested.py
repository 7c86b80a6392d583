"""Random robots of nested models, and what comes of a text when it is edited."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from hypothesis import strategies as st

from checker.finding import Fix, Safety
from checker.fix.rounds import EditedText, take
from checker.formats.sdf.flattening.flatten import Flattening, obstacle
from checker.formats.sdf.flattening.names import FlatNames
from checker.formats.sdf.reader import read_sdf
from checker.model.robot import Robot
from tests.dynamics.bodies import box, inertial, masses, poses, sizes, words
from tests.model.robots import document

NOTHING: Mapping[str, str] = {}
TYPES = ("fixed", "revolute", "prismatic", "universal")
AXES = ("1 0 0", "0 1 0", "0 0 -1", "1 2 3")
quarters = st.sampled_from([0.0, 1.5707963267948966, 3.141592653589793, -1.5707963267948966])
some_poses = st.one_of(poses, st.tuples(*[st.floats(-2, 2)] * 3, *[quarters] * 3))


@dataclass
class Nest:
    """A robot being written: texts, and the links that joints can still reach.

    Attributes:
        version: SDF version.
        files: Included models by the URI of their files.
    """

    draw: st.DrawFn
    version: str
    files: dict[str, str] = field(default_factory=dict)
    count: int = 0

    @property
    def by_frames(self) -> bool:
        return self.version not in ("1.4", "1.5", "1.6")

    def number(self) -> int:
        self.count += 1
        return self.count

    def pose(self, frames: list[str]) -> str:
        """A pose, mostly in the frame that it stands in anyway; now and then there is none."""
        draw = self.draw
        if draw(st.integers(0, 5)) == 0:
            return ""
        other = ""
        if self.by_frames and frames and draw(st.booleans()):
            other = f' relative_to="{draw(st.sampled_from(frames))}"'
        return f"    <pose{other}>{words(draw(some_poses))}</pose>\n"

    def model(self, depth: int) -> tuple[str, list[str]]:
        """The inside of a model, and its links as they are called in it."""
        draw, frames = self.draw, ["__model__"]
        lines: list[str] = []
        links: list[str] = []
        for _ in range(draw(st.integers(1, 3))):
            if depth and draw(st.booleans()):
                text, inner, name = self.nested(depth - 1, frames)
                lines.append(text)
                inner = [f"{name}::{each}" for each in inner]
                frames += [name, *inner] if self.by_frames else []
            else:
                name = f"link{self.number()}"
                lines.append(self.link(name, frames))
                inner = [name]
                frames += inner
            if links:
                lines.append(self.joint(draw(st.sampled_from(links)), inner[0], frames))
            links += inner
        if self.by_frames and draw(st.booleans()):
            lines.append(self.frame(links, frames))
        return "".join(lines), links

    def link(self, name: str, frames: list[str]) -> str:
        mass, sides = self.draw(masses), self.draw(st.tuples(sizes, sizes, sizes))
        own = inertial(mass, box(mass, *sides), self.draw(some_poses))
        return f'  <link name="{name}">\n{self.pose(frames)}    {own}\n  </link>\n'

    def frame(self, links: list[str], frames: list[str]) -> str:
        """A frame, attached to the model, to a link or to nothing in particular."""
        name, draw = f"frame{self.number()}", self.draw
        to = draw(st.sampled_from(["", "__model__", *links]))
        tied = f' attached_to="{to}"' if to else ""
        text = f'  <frame name="{name}"{tied}>\n{self.pose(frames)}  </frame>\n'
        frames.append(name)
        return text

    def joint(self, parent: str, child: str, frames: list[str]) -> str:
        kind = self.draw(st.sampled_from(TYPES))
        axes = "".join(self.axis(tag, frames) for tag in ("axis", "axis2")[: _count(kind)])
        return (
            f'  <joint name="joint{self.number()}" type="{kind}">\n{self.pose(frames)}'
            f"    <parent>{parent}</parent>\n    <child>{child}</child>\n{axes}  </joint>\n"
        )

    def axis(self, tag: str, frames: list[str]) -> str:
        draw, inside, said = self.draw, "", ""
        if self.by_frames and draw(st.booleans()):
            said = f' expressed_in="{draw(st.sampled_from(frames))}"'
        elif not self.by_frames and draw(st.booleans()):
            inside = "<use_parent_model_frame>1</use_parent_model_frame>"
        xyz = draw(st.sampled_from(AXES))
        xyz = f"<xyz{said}>{xyz}</xyz>" if said or draw(st.booleans()) else ""
        return f"    <{tag}>{xyz}{inside}</{tag}>\n"

    def nested(self, depth: int, frames: list[str]) -> tuple[str, list[str], str]:
        """A model in place or in a file of its own, its links, and its name."""
        inside, links = self.model(depth)
        name, pose = f"model{self.number()}", self.pose(frames)
        if self.draw(st.booleans()):
            return f'  <model name="{name}">\n{pose}{inside}  </model>\n', links, name
        uri = f"{name}/model.sdf"
        own = self.pose([])
        self.files[uri] = (
            f'<sdf version="{self.version}">\n<model name="{name}">\n{own}{inside}</model>\n</sdf>'
        )
        # The name stands in the way of nothing: two may be included from one file.
        given = f"given{self.number()}"
        include = f"<uri>{uri}</uri>\n    <name>{given}</name>"
        return f"  <include>\n    {include}\n{pose}  </include>\n", links, given


def _count(kind: str) -> int:
    return {"fixed": 0, "universal": 2}.get(kind, 1)


@st.composite
def nests(draw: st.DrawFn, versions: tuple[str, ...]) -> tuple[str, dict[str, str]]:
    """The text of a robot of nested models, and the files that it includes."""
    nest = Nest(draw, draw(st.sampled_from(versions)))
    inside, links = nest.model(3)
    text, inner, name = nest.nested(1, ["__model__"])
    joint = nest.joint(links[0], f"{name}::{inner[0]}", ["__model__"])
    model = f'<model name="robot">\n{inside}{text}{joint}</model>'
    return f'<sdf version="{nest.version}">\n{model}\n</sdf>', nest.files


def read(text: str, files: Mapping[str, str] = NOTHING) -> Robot:
    documents = {uri: document(inside, uri) for uri, inside in files.items()}
    (robot,) = read_sdf(document(text), lambda uri: documents.get(uri.value, "is not available"))
    return robot


def flattened(text: str, files: Mapping[str, str] = NOTHING) -> str:
    """Return the text of a robot once it is flattened."""
    robot = read(text, files)
    assert not obstacle(robot)
    edits = Flattening(robot, FlatNames.from_robot(robot)).edits
    edited = EditedText(robot.document.source)
    assert take(Fix(Safety.UNSAFE, edits), {"model.sdf": edited})
    return edited.result
