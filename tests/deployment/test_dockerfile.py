"""The Dockerfile says what it should, as far as that is seen without running it."""

from __future__ import annotations

import json
import re
import shlex
import subprocess
import sysconfig
from pathlib import Path

import pytest

from checker import cli
from tests.deployment.dockerfile import DockerStage, Instruction, stages

ROOT = Path(__file__).parent.parent.parent
STAGES = stages((ROOT / "Dockerfile").read_text("utf-8"))
LAST = STAGES[-1]


def test_hadolint_finds_nothing() -> None:
    hadolint = Path(sysconfig.get_path("scripts")) / "hadolint"
    done = subprocess.run(
        [hadolint, ROOT / "Dockerfile"], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


@pytest.mark.parametrize("stage", STAGES, ids=lambda stage: stage.name or "last")
def test_images_are_named_by_version(stage: DockerStage) -> None:
    assert re.fullmatch(r"(node:\d+-bookworm-slim|python:3\.\d+-slim-bookworm)", stage.image)


def test_the_interpreter_is_the_one_that_the_environment_was_made_with() -> None:
    (build,) = (stage for stage in STAGES if stage.name == "build")
    assert build.image == LAST.image


def test_it_names_no_place_to_download_from() -> None:
    assert "://" not in re.sub(r"https?://127\.0\.0\.1", "", (ROOT / "Dockerfile").read_text())


def test_whatever_pip_installs_is_pinned() -> None:
    told = [word for stage in STAGES for word in stage.all("RUN")]
    installs = [part for run in told for part in run.split("&&") if re.search(r"\binstall\b", part)]
    by_pip = [shlex.split(part) for part in installs if part.split()[0] == "pip"]
    assert by_pip
    for words in by_pip:
        assert words[words.index("-c") + 1] == "constraints.txt"


def test_it_runs_as_a_user_by_number_who_is_not_root() -> None:
    user, group = map(int, LAST.only("USER").split(":"))
    assert user >= 10_000
    assert f"install -d -m 0700 -o {user} -g {group} {LAST.only('VOLUME')}" in LAST.only("RUN")
    after = [each.word for each in LAST.instructions]
    assert not {"RUN", "COPY"} & set(after[after.index("USER") :])


def test_what_is_written_lies_where_the_container_may_write() -> None:
    pairs = (word.partition("=") for word in shlex.split(LAST.only("ENV")))
    environment = {name: value for name, _, value in pairs}
    assert environment["SUBT_CHECK_DATA"] == LAST.only("VOLUME")
    for name in ("HOME", "SUBT_CHECK_CACHE"):
        assert Path(environment[name]).is_relative_to("/tmp")  # noqa: S108


def test_no_secret_is_baked_in() -> None:
    told = " ".join(text for stage in STAGES for text in (*stage.all("ENV"), *stage.all("ARG")))
    assert not re.search(r"TOKEN|PASSWORD|SECRET|DATABASE_URL", told, re.IGNORECASE)


def test_what_it_starts_is_understood() -> None:
    assert json.loads(LAST.only("ENTRYPOINT")) == ["subt-check"]
    command = json.loads(LAST.only("CMD"))
    arguments = cli.build_parser().parse_args(command)
    assert arguments.host == "0.0.0.0"  # noqa: S104 - whoever runs it maps the port
    assert str(arguments.port) == LAST.only("EXPOSE")
    assert f"127.0.0.1', {arguments.port}" in LAST.only("HEALTHCHECK")


def test_the_viewer_is_made_as_the_makefile_makes_it() -> None:
    (viewer,) = (stage for stage in STAGES if stage.name == "viewer")
    assert f" {viewer.only('RUN')}\n" in (ROOT / "Makefile").read_text("utf-8")


def test_the_reader_joins_lines_and_passes_over_comments() -> None:
    (stage,) = stages("# x\nFROM a:1 AS b\nRUN one \\\n# between\n && two\n\nUSER 1\n")
    assert (stage.image, stage.name) == ("a:1", "b")
    assert stage.instructions == (Instruction("RUN", "one  && two"), Instruction("USER", "1"))
