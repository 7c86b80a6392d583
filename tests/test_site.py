"""The site of docs/: built without a warning, so that no link in it is dead, and searchable."""

from __future__ import annotations

import json
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from checker.report.sarif import help_uri
from checker.rulebook.discovery import all_rules
from tests.conftest import SAMPLES

ROOT = SAMPLES.parent
_PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
DOCUMENTATION = _PROJECT["urls"]["Documentation"]
pytestmark = pytest.mark.programs


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-b", "html"]
    done = subprocess.run(
        [*command, "-d", folder / "trees", ROOT / "docs", folder / "html"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return folder / "html"


def test_every_page_is_there_and_found(site: Path) -> None:
    index = (site / "searchindex.js").read_text("utf-8")
    found = json.loads(index.removeprefix("Search.setIndex(").removesuffix(")"))
    pages = {page.relative_to(ROOT / "docs").with_suffix("") for page in ROOT.glob("docs/**/*.md")}
    assert set(found["docnames"]) == set(map(str, pages)) - {"README"}
    assert "diffdriv" in found["terms"]
    assert (site / "search.html").is_file()


def test_findings_link_to_the_pages_of_their_rules(site: Path) -> None:
    for rule in all_rules():
        page = site / help_uri(rule.id).removeprefix(f"{DOCUMENTATION}/")
        assert f"<h1>{rule.name} ({rule.id})" in page.read_text("utf-8")


def test_the_reference_tells_of_all_public_names(site: Path) -> None:
    import checker

    page = (site / "reference.html").read_text("utf-8")
    assert not [name for name in checker.__all__ if f'id="subt_check.{name}"' not in page]
    assert 'id="subt_check.rule_testing.check_example"' in page


def test_links_to_files_lead_to_the_repository(site: Path) -> None:
    page = (site / "tutorials/write-a-rule.html").read_text("utf-8")
    assert "/subt-check/blob/main/CONTRIBUTING.md#add-a-rule" in page
