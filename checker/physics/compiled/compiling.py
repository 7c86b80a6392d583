"""Compiles the models of MuJoCo of a package, in processes with limits."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from msgspec import convert

from checker.base.background import Background, Work, work_key
from checker.base.cache import Cache
from checker.base.child_process import Limits
from checker.base.extras import PHYSICS
from checker.base.files import read_bytes
from checker.base.output import Stages
from checker.base.parts import NotAvailable, WorkerFailed, part
from checker.formats.mjcf.model import MjcfModel
from checker.physics.compiled.model import Compiled, CompiledModel, CompiledModels
from checker.physics.compiled.text import SIZE_LIMIT, mujoco_text

LIMITS = Limits(seconds=60.0, memory=3_000_000_000)
_MODULE = f"{__package__}.worker"


@part
def compiled_models(models: tuple[MjcfModel, ...], cache: Cache, stages: Stages) -> CompiledModels:
    """Return the models as MuJoCo compiles them."""
    PHYSICS.require_for("a model of MuJoCo")
    made: list[CompiledModel] = []
    missing: list[str] = []
    with stages.stage("mujoco", "compiling models in MuJoCo"):
        for model in models:
            if not model.is_whole:
                continue  # what is missing is a finding
            compiled = _compiled(model, cache)
            if isinstance(compiled, str):
                missing.append(f"{model.file}: {compiled}")
            else:
                made.append(compiled)
    return CompiledModels(tuple(made), tuple(missing))


@part
def each_compiled(models: CompiledModels) -> tuple[CompiledModel, ...] | NotAvailable:
    """Return each model that MuJoCo accepts, or accepts without what it refuses."""
    accepted = tuple(each for each in models.models if each.compiled.bodies)
    if accepted:
        return accepted
    refused = next((f"MuJoCo refuses {it.model.file}" for it in models.models), "")
    absent = "a file that the model includes cannot be read"
    return NotAvailable(next(filter(None, (refused, *models.missing)), absent))


def _compiled(model: MjcfModel, cache: Cache) -> CompiledModel | str:
    text = mujoco_text(model)
    if text.obstacle:
        return text.obstacle
    item = {
        "text": text.text,
        "attached": dict(text.attached),
        "files": dict(text.files),
        "absent": list(text.absent),
    }
    contents = [_content(place) for place in text.files.values()]
    texts = (text.text, *text.attached.values(), *text.files, *text.absent)
    key = work_key((*texts, *contents), ["physics/compiled"], ("mujoco",))
    work = Work("compiled", _MODULE, LIMITS, {key: item}, _decode, files=_files)
    result = Background(work, cache).result()
    if isinstance(result, WorkerFailed):
        return f"MuJoCo {result.reason}"
    return CompiledModel(model, text, result)


def _content(place: str) -> bytes:
    """Return the content of a file on disk; empty if it cannot be read."""
    content = read_bytes(Path(place), place, SIZE_LIMIT)
    return content if isinstance(content, bytes) else b""


def _files(item: Any) -> list[tuple[str, int]]:
    return [(place, SIZE_LIMIT) for place in item["files"].values()]


def _decode(answer: Any) -> Compiled:
    return convert(answer, Compiled)
