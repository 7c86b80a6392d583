"""The site of these pages: `make docs`."""

from __future__ import annotations

import posixpath
import re
import sys
import tomllib
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT))
_PROJECT: dict[str, Any] = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]

project = "subt-check"
copyright = "the subt-check authors"
version = release = _PROJECT["version"]
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
root_doc = "index"
# The index for who reads the files themselves.
exclude_patterns = ["README.md"]

html_theme = "furo"
html_title = "subt-check"
html_theme_options = {
    "source_repository": _PROJECT["urls"]["Homepage"],
    "source_directory": "docs/",
}

myst_heading_anchors = 3
autodoc_member_order = "bysource"
autodoc_typehints = "description"
python_use_unqualified_type_names = True
# Names that users replace, and addresses of services of their own.
linkcheck_ignore = [r".*OWNER.*", r"https?://(127\.0\.0\.1|localhost)\b.*"]
linkcheck_timeout = 20
# Examples of rules are parts of files, and some are wrong on purpose.
suppress_warnings = ["misc.highlighting_failure"]

_LINK = re.compile(r"(?<=\]\()(\.\.?/[^)\s#]+)")


def _lead_into_the_repository(_app: Any, page: str, text: list[str]) -> None:
    """Let links to files that are no pages lead to where the repository is."""

    def target(found: re.Match[str]) -> str:
        path = posixpath.normpath(posixpath.join("docs", posixpath.dirname(page), found[1]))
        if path.startswith("docs/"):
            return found[1]
        if not (ROOT / path).exists():
            raise ValueError(f"{page}: {found[1]} leads to nothing")
        return f"{_PROJECT['urls']['Homepage']}/blob/main/{path}"

    text[0] = _LINK.sub(target, text[0])


def _write_generated() -> None:
    """Write the pages of rules and the checklist; a page that is as it should be stays."""
    from checker.rulebook.checklist import to_markdown
    from checker.rulebook.discovery import all_rules
    from checker.rulebook.site import site_pages

    folder = ROOT / "docs/rules"
    folder.mkdir(exist_ok=True)
    texts = {folder / name: text for name, text in site_pages(all_rules()).items()}
    for stale in {*folder.iterdir()} - texts.keys():
        stale.unlink()
    texts[ROOT / "docs/checklist.md"] = to_markdown(all_rules())
    for page, text in texts.items():
        if not page.exists() or page.read_text("utf-8") != text:
            page.write_text(text, "utf-8")


def setup(app: Any) -> None:
    """Write the generated pages, and connect what Sphinx calls."""
    _write_generated()
    app.connect("source-read", _lead_into_the_repository)
