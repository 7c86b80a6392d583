"""What a fix may damage: whether files are still valid, and names that others still use."""

from __future__ import annotations

import ast
import re
import shutil
import subprocess
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

import yaml
from lxml import etree

Files = Mapping[str, bytes]
"""Contents by path."""

XML = (".xml", ".launch", ".sdf", ".world", ".urdf", ".xacro", ".config")
_NAMED = ("link", "joint", "model", "robot", "frame")
_WORD = re.compile(r"[\w.-]+")
_PROJECT = re.compile(rb"\bproject\s*\(\s*([\w.-]+)")


def contents(folder: Path) -> dict[str, bytes]:
    """Return all files of a folder; links are left out."""
    found = (path for path in folder.rglob("*") if path.is_file() and not path.is_symlink())
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in found}


def is_xml(data: bytes) -> bool:
    return parsed(data) is not None


def parsed(data: bytes) -> etree._Element | None:
    try:
        return etree.fromstring(data, etree.XMLParser(resolve_entities=False, huge_tree=True))
    except etree.XMLSyntaxError:
        return None


def is_yaml(data: bytes) -> bool:
    try:
        list(yaml.safe_load_all(data))
    except (yaml.YAMLError, UnicodeError):
        return False
    return True


def is_python(data: bytes) -> bool:
    try:
        ast.parse(data)
    except (SyntaxError, ValueError):
        return False
    return True


def is_ruby(data: bytes) -> bool:
    program = shutil.which("ruby")
    if program is None:
        return True
    done = subprocess.run([program, "-c"], input=data, capture_output=True, check=False)
    return done.returncode == 0


VALID: Mapping[str, Callable[[bytes], bool]] = {
    **dict.fromkeys(XML, is_xml),
    **dict.fromkeys((".yaml", ".yml"), is_yaml),
    ".py": is_python,
    ".rb": is_ruby,
}


def spoilt(before: Files, after: Files) -> Iterator[str]:
    """Yield the files that were valid and are not any more, or are gone."""
    for path, data in before.items():
        valid = VALID.get(Path(path).suffix)
        if path not in after:
            yield f"{path} is gone"
        elif valid and data != after[path] and valid(data) and not valid(after[path]):
            yield f"{path} is not valid any more"


def names(files: Files) -> set[str]:
    """Return what package, project, models, links, joints and frames are called."""
    found: set[str] = set()
    for path, data in files.items():
        if path.endswith("CMakeLists.txt"):
            found |= {match.decode() for match in _PROJECT.findall(data)}
        root = parsed(data) if path.endswith(XML) else None
        for element in root.iter("*") if root is not None else ():
            if element.tag in _NAMED and element.get("name"):
                found.add(str(element.get("name")))
            elif path.endswith("package.xml") and element.tag == "name":
                found.add((element.text or "").strip())
    return found


def lost(before: Files, after: Files) -> Iterator[str]:
    """Yield names that nothing has any more and that a file still mentions as it did before.

    `{name}` for `${name}` of xacro is no name that anything can mention.
    """
    gone = {name for name in names(before) - names(after) if _WORD.fullmatch(name)}
    for path, data in after.items() if gone else ():
        if data[:1000].count(0):
            continue
        words = set(_WORD.findall(data.decode("utf-8", "replace")))
        for name in sorted(gone):
            if set(_WORD.findall(name)) <= words and name.encode() in data:
                yield f"{path} mentions {name}, which is gone"
