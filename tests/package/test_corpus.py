"""The real packages: their kinds, and what the four aliases inherit."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from checker.base.files import NotReadable
from checker.package.inheritance import Found, Missing, Part
from checker.package.inputs import open_input
from checker.package.kind import PackageKind
from checker.source.text import SourceText

ALIASES = (
    "coro_jeanine",
    "csiro_data61_ozbot_atr",
    "ctu_cras_norlab_absolem",
    "robotika_freyja",
)
LAUNCH = ("launch/vehicle_topics.launch", "launch/description.launch")


def test_kinds_of_all_packages(corpus: Path) -> None:
    with open_input(corpus) as opened:
        kinds = {package.name: package.kind for package in opened.packages}
        assert opened.skipped == ()
    assert len(kinds) == 18
    aliases = {name for name, kind in kinds.items() if kind is PackageKind.CONFIGURATION}
    assert aliases == {f"{alias}_sensor_config_2" for alias in ALIASES}
    assert {kinds[name] for name in kinds if name not in aliases} == {PackageKind.ROBOT}


@pytest.mark.parametrize("alias", ALIASES)
def test_alias_inherits_from_config_1(corpus: Path, alias: str) -> None:
    base = f"{alias}_sensor_config_1"
    with open_input(corpus / f"{alias}_sensor_config_2") as opened:
        (package,) = opened.packages
        model = package.model_path
        assert isinstance(model, Found)
        assert model.path == f"../{base}/model.sdf"
        assert isinstance(package.read(model.path), SourceText)
        for part in (*LAUNCH, "specifications.md"):
            found = package.part(part)
            assert isinstance(found, Found)
            assert found.path == f"../{base}/{part}"
        assert {item.package_name for item in package.inherited} == {base}
        loads_ruby = alias in ("ctu_cras_norlab_absolem", "robotika_freyja")
        assert (Part.SPAWNER in {item.part for item in package.inherited}) is loads_ruby


@pytest.mark.parametrize("alias", ALIASES)
def test_alias_alone_names_the_sibling(corpus: Path, alias: str, tmp_path: Path) -> None:
    name, base = f"{alias}_sensor_config_2", f"{alias}_sensor_config_1"
    shutil.copytree(corpus / name, tmp_path / name)
    with open_input(tmp_path / name) as opened:
        (package,) = opened.packages
        assert package.kind is PackageKind.CONFIGURATION
        for found in (package.model_path, *map(package.part, (*LAUNCH, "specifications.md"))):
            assert isinstance(found, Missing)
            assert found.package_not_at_hand == base
        assert {(item.package_name, item.at_hand) for item in package.inherited} == {(base, False)}


def test_robots_inherit_nothing_and_every_text_reads(corpus: Path) -> None:
    with open_input(corpus) as opened:
        for package in opened.packages:
            assert package.index.faults == ()
            assert not [
                path for path in package.xml_files if isinstance(package.read(path), NotReadable)
            ]
            if package.kind is PackageKind.ROBOT:
                assert package.inherited == ()


def test_missing_specification_is_the_package_s_own_lack(corpus: Path) -> None:
    with open_input(corpus / "x1_sensor_config_6") as opened:
        found = opened.packages[0].part("specifications.md")
    assert found == Missing("specifications.md", "x1_sensor_config_6 has no specifications.md")


def test_every_package_is_opened(corpus: Path) -> None:
    for folder in sorted(path for path in corpus.iterdir() if path.is_dir()):
        with open_input(folder) as opened:
            (package,) = opened.packages
            assert package.name == folder.name
            assert package.kind
            assert package.inherited is not None
