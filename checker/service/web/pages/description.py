"""The description of the API, as a page for people tells it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from checker.base.record import Record

_KINDS = {"string": "text", "integer": "whole number", "boolean": "true or false"}
_ABOUT = {
    "id": "Id of the check.",
    "folder": "Folder of a package, as in PackageView.",
}
"""Of parameters that have one meaning everywhere."""
_METHODS = ("post", "get", "put", "patch", "delete")
"""In the order in which they are shown at one address."""
_TITLES = {"checks": "Checks", "health": "Health"}
"""Of the groups, in their order."""
_SECRET = "$SECRET"  # noqa: S105 - what stands for one in an example
_VALUES = {"id": "$ID", "folder": "$FOLDER", "Subt-Check-Secret": _SECRET}
"""What examples put in the place of values, as variables of a shell."""


class Member(Record):
    """A parameter, a field of a form, or a member of an answer.

    Attributes:
        kind: Its type in words, such as `text` or `list of PackageView`.
        where: `path`, `query`, `header`, `form`; empty in an answer.
        needed: Whether it has to be there.
        about: What it is; may be empty.
    """

    name: str
    kind: str
    where: str = ""
    needed: bool = False
    about: str = ""


class Outcome(Record):
    """How a request may be answered.

    Attributes:
        status: Of HTTP.
        about: What it means.
        kind: What is in the body; empty for nothing.
    """

    status: str
    about: str
    kind: str = ""


class Operation(Record):
    """What can be done at an address.

    Attributes:
        anchor: Its place on the page.
        example: A command for a shell.
    """

    method: str
    path: str
    anchor: str
    about: str
    members: tuple[Member, ...]
    outcomes: tuple[Outcome, ...]
    example: str


class Group(Record):
    """Operations on one kind of thing."""

    title: str
    operations: tuple[Operation, ...]


class Shape(Record):
    """A kind of JSON that answers have, by its name: an object, or one of some words."""

    name: str
    about: str
    members: tuple[Member, ...]
    words: tuple[str, ...] = ()


def groups_of(description: Mapping[str, Any], address: str) -> tuple[Group, ...]:
    """Return what the API can do.

    Args:
        description: Of the API, by OpenAPI.
        address: Of the service, for the examples.
    """
    found: dict[str, list[Operation]] = {tag: [] for tag in _TITLES}
    for path, methods in description["paths"].items():
        for method in sorted(methods, key=_METHODS.index):
            told = methods[method]
            tag = (told.get("tags") or ["other"])[0]
            found.setdefault(tag, []).append(_operation(method, path, told, address))
    return tuple(
        Group(_TITLES.get(tag, tag.capitalize()), tuple(operations))
        for tag, operations in found.items()
        if operations
    )


def shapes_of(description: Mapping[str, Any]) -> tuple[Shape, ...]:
    """Return the kinds of JSON that answers have, in the order of their names."""
    schemas = description["components"]["schemas"]
    return tuple(
        Shape(name, _text(schema), tuple(_members(schema)), tuple(schema.get("enum", ())))
        for name, schema in sorted(schemas.items())
    )


def _operation(method: str, path: str, told: Mapping[str, Any], address: str) -> Operation:
    form = told.get("requestBody", {}).get("content", {}).get("multipart/form-data", {})
    members = [
        Member(
            each["name"],
            _kind(each["schema"]),
            each["in"],
            each.get("required", False),
            each.get("description") or _ABOUT.get(each["name"], ""),
        )
        for each in told.get("parameters", ())
    ]
    members += _members(form.get("schema", {}), "form")
    return Operation(
        method.upper(),
        path,
        f"{method}{path}".translate(str.maketrans("/.", "--", "{}")).lower(),
        _text(told),
        tuple(members),
        tuple(_outcome(status, answer) for status, answer in sorted(told["responses"].items())),
        _example(method, path, members, _kind_of_success(told), address),
    )


def _outcome(status: str, answer: Mapping[str, Any]) -> Outcome:
    about = answer.get("description", "")
    content = answer.get("content", {})
    kinds = [
        _kind(each["schema"]) if each.get("schema") else media for media, each in content.items()
    ]
    shown = "It went well." if about == "Successful Response" else about
    return Outcome(status, shown, ", ".join(kinds))


def _kind_of_success(told: Mapping[str, Any]) -> str:
    answers = (told["responses"][status] for status in sorted(told["responses"]))
    return next((media for answer in answers for media in answer.get("content", {})), "")


def _members(schema: Mapping[str, Any], where: str = "") -> Iterator[Member]:
    needed = schema.get("required", ())
    for name, member in schema.get("properties", {}).items():
        yield Member(name, _kind(member), where, name in needed, member.get("description", ""))


def _kind(schema: Mapping[str, Any]) -> str:
    """Return a type in words."""
    if reference := schema.get("$ref"):
        return str(reference).rpartition("/")[2]
    inner = schema.get("items" if schema.get("type") == "array" else "additionalProperties")
    if isinstance(inner, Mapping):
        return f"{'list' if 'items' in schema else 'map'} of {_kind(inner)}"
    if schema.get("format") == "binary":
        return "file"
    kind = str(schema.get("type", "any"))
    return " or ".join(map(_kind, schema.get("anyOf", ()))) or _KINDS.get(kind, kind)


def _text(told: Mapping[str, Any]) -> str:
    """Return what is said of a thing: its first paragraph."""
    return " ".join(str(told.get("description", "")).split("\n\n")[0].split())


def _example(method: str, path: str, members: list[Member], media: str, address: str) -> str:
    """Return a command that does it, with variables of a shell for what only the reader knows."""
    words = ["curl"]
    if method not in ("get", "post"):
        words.append(f"--request {method.upper()}")
    elif method == "post" and not any(each.where == "form" for each in members):
        words.append("--request POST")
    for each in members:
        if each.where == "header" and each.name in _VALUES:
            words.append(f'--header "{each.name}: {_VALUES[each.name]}"')
        if each.where == "form" and each.kind == "file":
            words.append(f"--form {each.name}=@rover.zip")
    if media == "text/event-stream":
        words.append("--no-buffer")
    elif (media and media != "application/json") or path.endswith((".json",)):
        words.append(f"--output {path.rpartition('/')[2]}")
    place = path
    for name, value in _VALUES.items():
        place = place.replace(f"{{{name}}}", value)
    words.append(f'"{address}{place}"')
    return " ".join(words)
