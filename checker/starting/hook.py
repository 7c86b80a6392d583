"""Adds the hook to a `.pre-commit-config.yaml` and leaves every other character as it is."""

from __future__ import annotations

from textwrap import indent
from typing import Any

from checker.resources import templates

ID = "subt-check"
NEW_FILE = "repos:\n"


def hook_entry() -> str:
    """Return the entry for the list `repos`."""
    return templates("init").joinpath("hook.yaml").read_text("utf-8")


def has_hook(text: str) -> bool:
    """Say whether a configuration runs the hook already, wherever it takes it from."""
    content = _loaded(text)
    repositories = content.get("repos") if isinstance(content, dict) else None
    hooks = [hook for each in _mappings(repositories) for hook in _mappings(each.get("hooks"))]
    return any(hook.get("id") == ID for hook in hooks)


def with_hook(text: str) -> str | None:
    """Return a configuration with the hook behind the others.

    None where it cannot be added as text with certainty: the result is read again, and must hold
    what was there before and the hook.
    """
    before = _loaded(text)
    place = _end_of_repositories(text)
    if place is None or not isinstance(before, dict) or not isinstance(before.get("repos"), list):
        return None
    end, column = place
    head = _without_trailing_comments(text[:end])
    line_end = "\r\n" if "\r\n" in text else "\n"
    entry = indent(hook_entry(), " " * column).replace("\n", line_end)
    joint = "" if head.endswith("\n") else line_end
    after = head + joint + entry + text[len(head) :]
    wanted = {**before, "repos": [*before["repos"], *_loaded(hook_entry())]}
    return after if _loaded(after) == wanted else None


def _mappings(value: object) -> list[dict[Any, Any]]:
    return [each for each in value if isinstance(each, dict)] if isinstance(value, list) else []


def _loaded(text: str) -> Any:
    """Return the content of YAML without aliases, by which a short text can mean a huge one."""
    import yaml

    try:
        if any(isinstance(token, yaml.AliasToken) for token in yaml.scan(text, yaml.SafeLoader)):
            return None
        return yaml.safe_load(text)
    except (yaml.YAMLError, ValueError, RecursionError):
        return None


def _end_of_repositories(text: str) -> tuple[int, int] | None:
    """Return where the block list `repos` ends, and the column of its dashes."""
    import yaml

    try:
        root = yaml.compose(text, yaml.SafeLoader)
    except (yaml.YAMLError, ValueError, RecursionError):
        return None
    for key, value in root.value if isinstance(root, yaml.MappingNode) else ():
        if key.value == "repos" and isinstance(value, yaml.SequenceNode) and not value.flow_style:
            return value.end_mark.index, value.start_mark.column
    return None


def _without_trailing_comments(text: str) -> str:
    """Cut blank lines and comments off an end: they belong to what follows."""
    lines = text.splitlines(keepends=True)
    while lines and (not lines[-1].strip() or lines[-1].lstrip().startswith("#")):
        lines.pop()
    return "".join(lines)
