"""How hostile launch files, YAML, CMake files, settings, sheets and pictures are read."""

from __future__ import annotations

import struct
import tempfile
import zlib
from functools import partial
from pathlib import Path

from checker.base.errors import InvalidSettings
from checker.launch.ros1.expansion import expand_launch
from checker.model.values import ValueReader
from checker.physics.mesh.appearance import picture
from checker.settings import FILE_NAME, find_settings
from checker.source.cmake import read_cmake
from checker.source.markdown import read_markdown
from checker.source.text import Located, SourceText
from checker.source.xml import XmlDocument, parse_xml
from checker.source.yaml import read_yaml
from tests.evaluated.files import CMAKE, LAUNCH, MARKDOWN, NUMBERS, SETTINGS, YAML


def _launch(content: str) -> str:
    document = parse_xml(SourceText("launch/a.launch", f"<launch>{content}</launch>"))
    assert isinstance(document, XmlDocument)
    graph = expand_launch(document, {}, lambda *_file: document)
    written = " ".join(value.value for value in graph.arguments.values())
    return f"{[each.message for each in graph.faults][:2]} {written[:100]}"


def _yaml(text: str) -> str:
    return str([each.message for each in read_yaml(SourceText("a.yaml", text)).faults][:2])


def _cmake(text: str) -> str:
    build = read_cmake(SourceText("CMakeLists.txt", text))
    return str([each.message for each in build.faults][:2])


def _settings(text: str) -> str:
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, FILE_NAME).write_text(text, "utf-8")
        try:
            find_settings([Path(folder)])
        except InvalidSettings as error:
            return error.problem
    return "were read"


def _markdown(text: str) -> str:
    sheet = read_markdown(SourceText("specifications.md", text))
    return f"{len(sheet.passages)} passages"


def _numbers(text: str) -> str:
    reader, source = ValueReader(), SourceText("model.sdf", text)
    reader.numbers_in(Located(text, source.whole()))
    return str([each.message for each in reader.faults])


def _png(width: int, height: int) -> bytes:
    def chunk(kind: bytes, data: bytes) -> bytes:
        return (
            struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        )

    header = chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
    packed = zlib.compress(bytes(20_000_000))
    return b"\x89PNG\r\n\x1a\n" + header + chunk(b"IDAT", packed) + chunk(b"IEND", b"")


PICTURES = {
    "a picture of a thousand million pixels": _png(30_000, 30_000),
    "a picture in PostScript": b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 9 9\n(%pipe%id)",
    "a picture in TIFF": b"II*\0\x08\0\0\0\xff\xff" + b"\xff" * 4000,
    "a picture in GIF": b"GIF89a\xff\xff\xff\xff\0\0\0,\0\0\0\0\xff\xff\xff\xff\0\2\0;",
}

ATTACKS = {
    **{name: partial(_launch, text) for name, text in LAUNCH.items()},
    **{name: partial(_yaml, text) for name, text in YAML.items()},
    **{name: partial(_cmake, text) for name, text in CMAKE.items()},
    **{name: partial(_settings, text) for name, text in SETTINGS.items()},
    **{name: partial(_markdown, text) for name, text in MARKDOWN.items()},
    **{name: partial(_numbers, text) for name, text in NUMBERS.items()},
    **{name: partial(picture, data) for name, data in PICTURES.items()},
}
