"""What all tests share: the corpus of real packages, where it is available."""

from __future__ import annotations

import os
import signal
import tempfile
from collections.abc import Generator, Iterator
from pathlib import Path

import pytest
from hypothesis import settings

from support.browser import chromium  # noqa: F401 (a fixture)
from support.bucket import bucket_url, object_store  # noqa: F401 (fixtures)
from support.postgres import postgres_url  # noqa: F401 (a fixture)
from support.real_packages import CORPUS, needed_folder, not_judged
from tests.effort import THOROUGH
from tests.tiers import MARKS, Guard, marks_of

# Machines differ and are shared: no example of a property is held against the clock. The gate tries
# the same examples each time, so that it decides by the change alone; `make test-all` tries others.
settings.register_profile("gate", deadline=None, max_examples=10, derandomize=True)
settings.register_profile(THOROUGH, deadline=None, max_examples=100)
settings.load_profile("gate")

# Where the tests run in the background, a shell has all that they start ignore Ctrl-C.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

SAMPLES = Path(__file__).parent.parent / "samples"
GUARD = Guard()


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--update-golden", action="store_true", help="write reports and generated pages anew"
    )


def pytest_configure(config: pytest.Config) -> None:
    for name, need in (MARKS | {"smoke": "is run by the gate too"}).items():
        config.addinivalue_line("markers", f"{name}: {need}")


def pytest_itemcollected(item: pytest.Item) -> None:
    for name in marks_of(item):
        item.add_marker(name)
    if item.get_closest_marker("root") and getattr(os, "geteuid", lambda: 1)() != 0:
        item.add_marker(pytest.mark.skip(reason="only root can"))


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    for line in not_judged():
        terminalreporter.write_line(line)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Generator[None, object, object]:
    GUARD.watch(item)
    try:
        return (yield)
    finally:
        GUARD.watch(None)


@pytest.fixture(scope="session")
def corpus() -> Path:
    """The folder of real packages that SUBT_CHECK_CORPUS names."""
    return needed_folder(CORPUS)


@pytest.fixture(scope="session")
def samples() -> Path:
    """The sample packages."""
    return SAMPLES


@pytest.fixture
def open_folder() -> Iterator[Path]:
    """A folder that every user may look into, which pytest's own is not."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder).chmod(0o755)
        yield Path(folder)


@pytest.fixture(scope="session", autouse=True)
def _cache_of_the_tests(
    pytestconfig: pytest.Config, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[None]:
    """Keep results of tests out of the user's cache, and the user's out of the tests.

    All workers and runs share them: their keys hold the code and the versions of libraries.
    """
    shared: pytest.Cache | None = getattr(pytestconfig, "cache", None)
    folder = shared.mkdir("results") if shared else tmp_path_factory.mktemp("results")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("SUBT_CHECK_CACHE", str(folder))
        yield
