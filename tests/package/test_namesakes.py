"""Files of `model://` where several folders have the name of the model."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.package.inputs import open_input
from checker.package.uris import path_behind

_EXPORT = '<export><gazebo_ros gazebo_model_path="${prefix}/shapes"/></export>'
_SDF = '<sdf version="1.6"><model name="hall"/></sdf>'


@pytest.mark.parametrize(
    ("files", "path"),
    [
        (("shapes/hall/meshes/a.stl", "old/hall/meshes/a.stl"), "shapes/hall/meshes/a.stl"),
        (("old/hall/meshes/a.stl",), "old/hall/meshes/a.stl"),
        (("worlds/hall/meshes/a.stl", "shapes/hall/meshes/a.stl"), ""),
        (("shapes/hall/a.stl",), ""),
    ],
)
def test_the_model_is_one_that_has_the_file(
    files: tuple[str, ...], path: str, tmp_path: Path
) -> None:
    texts = {
        "package.xml": f"<package><name>arena</name>{_EXPORT}</package>",
        "launch/arena.launch.py": "",
        "worlds/hall/model.sdf": _SDF,
        "worlds/hall/model.config": "<model><name>hall</name></model>",
        **dict.fromkeys(files, "solid\nendsolid\n"),
    }
    for name, text in texts.items():
        file = tmp_path / "arena" / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
    with open_input(tmp_path) as opened:
        (hall,) = (it for it in opened.packages if it.root.name == "hall")
        found = path_behind(hall, "", "model://hall/meshes/a.stl")

    assert found == (f"../arena/{path}" if path else "meshes/a.stl")
