"""Renaming parts of real robots: nothing that the static rules report gets worse."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest

from checker.base.cache import Cache, cache_folder
from checker.editor.names.index import NameIndex, names_of
from checker.editor.names.mention import Mention, NameKind
from checker.engine.review import findings_of
from checker.package.inputs import open_input
from checker.package.package import Package
from checker.settings import Settings
from checker.source.text import SourceText
from support.real_packages import MODERN, named_folder
from tests.editor.packages import edited, texts
from tests.effort import examples, limited

SETTINGS = Settings(trial=False)
PARTS = (NameKind.LINK, NameKind.JOINT, NameKind.FRAME, NameKind.SENSOR)
ENDING = "_renamed"
BY_NAME = frozenset({"KIN011"})
"""Rules that ask for a certain name: `base_link`."""


def definitions(index: NameIndex, kinds: Sequence[NameKind]) -> list[Mention]:
    """Return one definition of each thing of the package's own robots."""
    things = {
        (it.kind, it.scope, it.name): it
        for it in index.mentions
        if it.is_definition and it.kind in kinds and not it.path.startswith("../")
    }
    return list(things.values())


def reported(package: Package) -> set[tuple[str, str]]:
    """Return what the static rules report, with old names for new ones."""
    found = findings_of(package, SETTINGS, Cache(cache_folder()))
    return {(it.rule, it.message.replace(ENDING, "")) for it in found if it.rule not in BY_NAME}


def check(package: Package, most: int) -> int:
    """Rename parts and look at what is reported; return how many could be renamed."""
    index = names_of(package)
    things = definitions(index, PARTS)
    before = reported(package) if things else set()
    count = 0
    for thing in things[:: max(1, len(things) // most)]:
        text = index.files[thing.path].source.text
        edits = index.rename(thing, text[thing.start : thing.end] + ENDING)
        if isinstance(edits, str):
            assert edits.split(), thing
            continue
        after = edited(package, edits)
        assert reported(after) <= before, thing
        back = names_of(after, index)
        moved = next(
            it
            for it in back.mentions
            if (it.kind, it.path, it.is_definition) == (thing.kind, thing.path, True)
            and it.name.removesuffix(ENDING) == thing.name
            and it.name != thing.name
        )
        undone = back.rename(moved, text[thing.start : thing.end])
        count += 1
        if isinstance(undone, str):
            assert "already used" in undone, "a model in it may have the same name"
            continue
        assert texts(edited(after, undone)) == texts(package)
    return count


@pytest.mark.corpus
def test_parts_of_submitted_robots(corpus: Path) -> None:
    with open_input(corpus) as opened:
        counts = {it.name: check(it, examples(20)) for it in opened.packages}
    assert sum(counts.values()) > len(counts), counts


MODERN_FOLDERS = ("create3_sim", "ros2_control_demos", "turtlebot3_simulations", "urdf_tutorial")


@pytest.mark.parametrize("folder", MODERN_FOLDERS)
@pytest.mark.corpus
@pytest.mark.skipif(named_folder(MODERN) is None, reason=f"{MODERN} names no folder")
def test_parts_of_robots_of_today(folder: str) -> None:
    root = named_folder(MODERN)
    assert root is not None
    with open_input(root / folder) as opened:
        counts = {it.name: check(it, examples(20)) for it in opened.packages}
    assert sum(counts.values()) > 0, counts


@pytest.mark.corpus
def test_each_mention_is_found_at_its_place(corpus: Path) -> None:
    with open_input(corpus) as opened:
        for package in opened.packages:
            index = names_of(package)
            for it in index.mentions:
                text = index.files[it.path].source.text[it.start : it.end]
                assert text, it
                assert it.kind is NameKind.TOPIC or text in it.name or it.kind is NameKind.SENSOR
                at = index.at(it.path, it.start + 1)
                assert at is not None
                assert at.start <= it.start + 1 <= at.end


@pytest.mark.corpus
def test_one_key_in_the_largest_model_takes_little_work(corpus: Path) -> None:
    models = sorted(corpus.glob("*/model.sdf"), key=lambda path: path.stat().st_size)
    with open_input(models[-1].parent) as opened:
        package = opened.packages[0]
        index = names_of(package)
        source = package.read("model.sdf")
        assert isinstance(source, SourceText)
        text = source.text.replace("<link name=", "<link  name=", 1)
        later = package.with_texts({"model.sdf": SourceText("model.sdf", text)})
        later.xml("model.sdf"), later.index
        with limited(0.06):
            after = names_of(later, index)
        assert after.files["model.sdf"] is not index.files["model.sdf"]
