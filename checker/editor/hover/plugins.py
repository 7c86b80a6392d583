"""Hover text of a plugin and its parameters."""

from __future__ import annotations

from collections.abc import Iterator

from checker.base.resources import table
from checker.editor.card import card, code, escaped_words, names
from checker.editor.plugin_facts import Parameter, PluginFacts, plugin_facts
from checker.model.locomotion.drive import DRIVE_CLASSES
from checker.model.plugin_library import library_stem, release_label
from checker.rule import Context
from checker.source.xml import Element

_SHOWN = 30
"""Parameters that are shown."""


def plugin_card(element: Element, target: Context, note: str = "") -> str:
    """Return what is known of a `<plugin>`, as Markdown.

    Args:
        element: The plugin.
        target: What the package is written for.
        note: What else to state.
    """
    filename, name = element.get("filename") or "", element.get("name") or ""
    facts = plugin_facts(filename, name, target)
    title = f"**plugin** {code(name or library_stem(filename))}"
    if facts is None:
        rows = [("library", code(filename)), ("sets", names(_set_here(element)))]
        return card(title, rows, note or "It is not one of Gazebo's that are known.")
    return card(title, _rows(facts, element, target), note)


def _rows(facts: PluginFacts, element: Element, target: Context) -> Iterator[tuple[str, str]]:
    last = (element.get("name") or "").rpartition("::")[2]
    yield "is", DRIVE_CLASSES.get(last, "")
    yield "library", f"{code(facts.library)} of {escaped_words(facts.title)}"
    is_title = facts.classes == (element.get("name"),)
    yield "classes", "" if is_title else names(facts.classes)
    yield "in", ", ".join(map(escaped_words, facts.releases))
    labels = table("gazebo_plugins")["releases"]
    if facts.releases and target.release in labels:
        label = release_label(target.release).removesuffix(" and SubT")
        if facts.title.startswith(("Gazebo Sim", "Ignition")) and label not in facts.releases:
            yield "target", f"{label} does not have it"
    yield "note", escaped_words(facts.note)
    used = _set_here(element)
    yield "sets", ", ".join(_as_set(facts, element, path) for path in used[:_SHOWN])
    left = [it for path, it in sorted(facts.parameters.items()) if path not in used]
    more = f" and {len(left) - _SHOWN} more" if len(left) > _SHOWN else ""
    yield "may set", ", ".join(map(_as_known, left[:_SHOWN])) + more


def _set_here(element: Element) -> list[str]:
    """Return the paths of the parameters that a plugin states, each once."""
    paths: dict[str, None] = {}
    for child in element.children:
        if not child.children and not child.attributes:
            paths[child.tag] = None
            continue
        paths |= {f"{child.tag}/@{name}": None for name in child.attributes}
        paths |= {f"{child.tag}/{inner.tag}": None for inner in child.children}
        if child.value:
            paths[child.tag] = None
    return list(paths)


def _as_set(facts: PluginFacts, element: Element, path: str) -> str:
    known = facts.parameters.get(path) or facts.parameters.get(path.rpartition("/")[2])
    child = element.child(*path.split("/"))
    value = f" = {code(child.value)}" if child is not None and child.value else ""
    is_known = known is not None or not facts.parameters or _tag_of(path) in _tags(facts)
    return f"{code(path)}{value}" + ("" if is_known else " (not one of its parameters)")


def _tag_of(path: str) -> str:
    return path.partition("/")[0]


def _tags(facts: PluginFacts) -> set[str]:
    return {parameter.tag for parameter in facts.parameters.values()}


def _as_known(parameter: Parameter) -> str:
    return (
        f"{code(parameter.path)} ({escaped_words(parameter.words)})"
        if parameter.words
        else code(parameter.path)
    )


def hardware_card(name: str) -> str | None:
    """Return what is known of a hardware component of ros2_control; None if nothing is."""
    known = table("ros2_control_hardware")["plugins"]
    entry = next((it for it in known if it["name"] == name), None)
    if entry is None:
        return None
    rows = [("kind", escaped_words(entry["kind"])), ("package", code(entry["package"]))]
    rows += [("in", ", ".join(entry["distros"])), ("note", escaped_words(entry.get("note", "")))]
    return card(f"**hardware** {code(name)}", rows)


def parameter_card(plugin: Element, path: str, value: str, target: Context) -> str | None:
    """Return what is known of a parameter of a plugin, as Markdown; None if nothing is.

    Args:
        plugin: The `<plugin>` around it.
        path: The path below it: `a/b`, with `@x` for an attribute.
        value: The value that the file states.
        target: The target of the package.
    """
    facts = plugin_facts(plugin.get("filename") or "", plugin.get("name") or "", target)
    if facts is None or not facts.parameters:
        return None
    last = path.rpartition("/")[2]
    known = facts.parameters.get(path) or facts.parameters.get(last)
    called = (plugin.get("name") or "").rpartition("::")[2] or library_stem(facts.library)
    title = f"**parameter** {code(path)} of {code(called)}"
    if known is None:
        inner = _tag_of(path) in _tags(facts)
        note = "" if inner else f"{escaped_words(facts.title)} reads no parameter of this name."
        return card(title, [], note) if note else None
    usual = code(known.usual) if known.usual else ""
    rows = [("type", escaped_words(known.words)), ("here", code(value) if value else "")]
    return card(title, [*rows, ("SubT packages often set", usual)])
