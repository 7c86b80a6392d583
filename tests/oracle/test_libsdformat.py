"""The checker accepts what libsdformat accepts, and reads the same robot."""

from __future__ import annotations

import os
import shutil
from collections.abc import Sequence
from pathlib import Path

import pytest

from support.real_packages import CORPUS, MODERN, REVIEWS, judged_folders, needs
from tests.conftest import SAMPLES
from tests.oracle.comparison import unexplained
from tests.oracle.conftest import Load
from tests.oracle.mutants import mutant

MODELS = Path(__file__).parent / "models"
MUTANTS = int(os.environ.get("SUBT_CHECK_MUTANTS", "480"))
"""How many mutants are compared: some thousands in a full run."""
PARTS = 6
"""Tests that the mutants are divided among, for several workers."""


def differing(files: Sequence[Path], libsdformat: Load) -> dict[str, list[str]]:
    """Return what is not explained, by file."""
    assert files
    loaded = zip(files, libsdformat(files), strict=True)
    found = {str(file): unexplained(file, theirs) for file, theirs in loaded}
    return {file: words for file, words in found.items() if words}


def models_in(folder: Path) -> list[Path]:
    """Return the model files below a folder."""
    return sorted(path for path in folder.rglob("*.sdf") if path.is_file())


@pytest.mark.parametrize("folder", [MODELS, SAMPLES], ids=["every way of writing", "samples"])
def test_models_are_read_alike(folder: Path, libsdformat: Load) -> None:
    assert not differing(models_in(folder), libsdformat)


@pytest.mark.parametrize(
    "variable",
    [pytest.param(name, marks=needs(name), id=name) for name in (CORPUS, MODERN, REVIEWS)],
)
def test_real_models_are_read_alike(variable: str, libsdformat: Load) -> None:
    models = [model for folder in judged_folders(variable) for model in models_in(folder)]
    assert not differing(models, libsdformat)


@pytest.mark.parametrize("part", range(PARTS))
def test_mutants_are_read_alike(part: int, tmp_path: Path, libsdformat: Load) -> None:
    shutil.copytree(MODELS / "part", tmp_path / "part")
    bases = [path.read_text("utf-8") for path in mutable()]
    files = []
    for seed in range(part, MUTANTS, PARTS):
        # A folder of its own, beside which the model lies that some include.
        folder = tmp_path / f"mutant_{seed}"
        folder.mkdir()
        (folder / "model.config").write_text("<model/>", "utf-8")
        file = folder / "model.sdf"
        file.write_text(mutant(bases[seed // PARTS % len(bases)], seed), "utf-8")
        files.append(file)
    assert not differing(files, libsdformat)


def mutable() -> list[Path]:
    """Return the models that mutants come of."""
    # libsdformat does not look at the pose of what stands alone at the top of a file.
    own = [path for path in models_in(MODELS) if path.parent.name != "top_1.9"]
    return [*own, *SAMPLES.glob("*/model.sdf")]
