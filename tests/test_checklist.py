"""Every item of the robot model checklist has a rule."""

from __future__ import annotations

import re

import pytest

from checker.rulebook.checklist import items, to_markdown
from checker.rulebook.discovery import all_rules


@pytest.mark.parametrize("item", [item for item, _ in items(all_rules())])
def test_item_has_a_rule(item: str) -> None:
    assert dict(items(all_rules()))[item]


def test_the_page_lists_the_rules_of_each_item() -> None:
    page = to_markdown(all_rules())
    for item, judged_by in items(all_rules()):
        section = page.partition(f"## {item[0].upper()}{item[1:]}\n")[2].partition("\n## ")[0]
        assert re.findall(r"^- \[(\w+)\]\(rules/\1\.md\)", section, re.M) == [
            r.id for r in judged_by
        ]
