"""Launch texts, and what they expand to."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import pytest

from checker.launch.ros1.expansion import expand_launch
from checker.launch.ros1.graph import LaunchGraph
from checker.launch.ros1.launch_file import MissingLaunchFile
from checker.source.text import SourceText
from checker.source.xml import XmlDocument, parse_xml

Expand = Callable[..., LaunchGraph]


def document(file: str, text: str) -> XmlDocument:
    parsed = parse_xml(SourceText(file, text))
    assert isinstance(parsed, XmlDocument), parsed
    return parsed


@pytest.fixture
def expand() -> Expand:
    """Expand the content of `<launch>`; `files` are those that the resolver finds, by path."""

    def expand_text(
        content: str, arguments: Mapping[str, str] | None = None, files: Mapping[str, str] = {}
    ) -> LaunchGraph:
        documents = {path: document(path, text) for path, text in files.items()}

        def read_launch(package: str, path: str, from_file: str) -> XmlDocument | str:
            assert from_file == "launch/main.launch" or from_file in documents
            if package == "elsewhere":
                return "package elsewhere is not available"
            path = f"../{package}/{path}" if package else path
            return documents.get(path) or MissingLaunchFile(f"{path} does not exist")

        main = document("launch/main.launch", f"<launch>{content}</launch>")
        return expand_launch(main, arguments or {}, read_launch)

    return expand_text
