"""Drake holds a newer libsdformat: what files of SDF 1.10 to 1.12 are to the checker and to it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.oracle.checked import checked

MODELS = Path(__file__).parent / "models"
# Drake takes no element that the version lacks, nor joints that it cannot move.
SHARED = ("frames_1.7", "nested_1.8")
LINKS = '<link name="a"/><link name="b"/>'
JOINT = '<joint name="{}" type="fixed"><parent>{}</parent><child>{}</child></joint>'
ENDS = '<link name="a"/><model name="m"><link name="b"/></model>'
VISUAL = '<link name="a"><visual name="v">{0}</visual><{1} name="v">{0}</{1}></link>'
SPHERE = "<geometry><sphere><radius>1</radius></sphere></geometry>"
WORLD = '<world name="w"><model name="m"><link name="a"/></model>{}</world>'
MASS = '<link name="a"><inertial><mass>{}</mass></inertial></link>'
ACCEPTED = {
    "a model as an end": ENDS + JOINT.format("j", "a", "m"),
    "__model__ as an end": ENDS + JOINT.format("j", "__model__", "m::b"),
    "a visual and a collision of one name": VISUAL.format(SPHERE, "collision"),
    "no geometry": '<link name="a"><visual name="v"/></link>',
    "words after a number": MASS.format("3.6 kg"),
    "a static model without links": "<static>true</static>",
}
REFUSED = {
    "two links of one name": '<link name="a"/><link name="a"/>',
    "two visuals of one name": VISUAL.format(SPHERE, "visual"),
    "a joint of a link's name": LINKS + JOINT.format("b", "a", "b"),
    "no parent": LINKS + '<joint name="j" type="fixed"><child>b</child></joint>',
    "an unknown end": LINKS + JOINT.format("j", "a", "c"),
    "a joint of one link": LINKS + JOINT.format("j", "a", "a"),
    "an unknown frame": '<link name="a"><pose relative_to="b"/></link>',
    "a blank name": '<link name=" "/>',
    "a word for a number": MASS.format("heavy"),
    "a pose of seven numbers": '<link name="a"><pose>0 0 0 0 0 0 0</pose></link>',
    "a light of a model's name": WORLD.format('<light name="m" type="point"/>'),
    "a frame of a model's name": WORLD.format('<frame name="m"/>'),
}
pytestmark = pytest.mark.parametrize("version", ["1.10", "1.11", "1.12"])


def bodies(file: Path) -> dict[str, float]:
    """Load a file, and return the masses of its bodies.

    Raises:
        RuntimeError: Drake refuses the file.
    """
    parsing = pytest.importorskip("pydrake.multibody.parsing", reason="drake is not installed")
    from pydrake.multibody.plant import MultibodyPlant

    plant = MultibodyPlant(0.001)
    parser = parsing.Parser(plant)
    parser.SetAutoRenaming(True)
    models = parser.AddModels(str(file))
    return {
        plant.get_body(index).name(): plant.get_body(index).default_mass()
        for model in models
        for index in plant.GetBodyIndices(model)
    }


def written(content: str, version: str, folder: Path) -> Path:
    """Write a model of a version, or a world, into a folder."""
    inside = content if content.startswith("<world") else f'<model name="r">{content}</model>'
    file = folder / "model.sdf"
    file.write_text(f'<sdf version="{version}">{inside}</sdf>', "utf-8")
    return file


@pytest.mark.parametrize("name", SHARED)
def test_the_same_bodies(name: str, version: str, tmp_path: Path) -> None:
    text = (MODELS / f"{name}.sdf").read_text("utf-8")
    file = tmp_path / "model.sdf"
    file.write_text(re.sub(r'<sdf version="[\d.]+"', f'<sdf version="{version}"', text), "utf-8")
    (robot,) = checked(file).robots.values()
    assert bodies(file) == {link.name.value: link.mass for link in robot.links}


@pytest.mark.parametrize("case", ACCEPTED)
def test_both_accept(case: str, version: str, tmp_path: Path) -> None:
    file = written(ACCEPTED[case], version, tmp_path)
    bodies(file)
    assert checked(file).errors == ()


@pytest.mark.parametrize("case", REFUSED)
def test_both_refuse(case: str, version: str, tmp_path: Path) -> None:
    file = written(REFUSED[case], version, tmp_path)
    with pytest.raises(RuntimeError):
        bodies(file)
    assert checked(file).errors


def test_a_version_that_does_not_exist(version: str, tmp_path: Path) -> None:
    file = written('<link name="a"/>', version + "0", tmp_path)
    with pytest.raises(RuntimeError, match="Unable to convert"):
        bodies(file)
    assert checked(file).errors
