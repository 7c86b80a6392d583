"""Texts as documents and as faults."""

from __future__ import annotations

from checker.source.text import SourceText
from checker.source.xml import XmlDocument, parse_xml
from checker.source.xml_positions import XmlFault


def document(text: str) -> XmlDocument:
    parsed = parse_xml(SourceText("model.sdf", text))
    assert isinstance(parsed, XmlDocument), f"{parsed.message}: {parsed.hint}"
    return parsed


def fault(text: str) -> XmlFault:
    parsed = parse_xml(SourceText("robot.launch", text))
    assert isinstance(parsed, XmlFault)
    return parsed
