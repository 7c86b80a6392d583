"""docs/checklist.md: every item of the robot model checklist has a rule."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.rulebook.checklist import items, to_markdown
from checker.rulebook.discovery import all_rules

PAGE = Path(__file__).parent.parent / "docs" / "checklist.md"


@pytest.mark.parametrize("item", [item for item, _ in items(all_rules())])
def test_item_has_a_rule(item: str) -> None:
    assert dict(items(all_rules()))[item]


def test_page_is_fresh(pytestconfig: pytest.Config) -> None:
    if pytestconfig.getoption("--update-golden"):
        PAGE.write_text(to_markdown(all_rules()), "utf-8")
    assert PAGE.read_text("utf-8") == to_markdown(all_rules())
