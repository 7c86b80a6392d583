"""The paperwork of a package: package.xml, model.config, CMakeLists.txt, each where it is there."""

from __future__ import annotations

from functools import cached_property

from checker.disk_file import NotReadable
from checker.model.paperwork import (
    ModelConfig,
    PackageManifest,
    read_model_config,
    read_package_xml,
)
from checker.package.package import Package
from checker.record import record
from checker.source.cmake import CMakeFile, read_cmake
from checker.source.positions import XmlFault
from checker.source.text import SourceText
from checker.source.xml import XmlDocument


@record(eq=False)
class Paperwork:
    """What a package's own paperwork says; nothing here is inherited."""

    package: Package

    def unread(self, path: str) -> str:
        """Return why a paper that is there cannot be read; empty when it can, or is missing."""
        if self.package.index.find(path) is None:
            return ""
        document = self.package.xml(path)
        if isinstance(document, NotReadable):
            return f"{path} {document.reason}"
        return f"{path} is not well-formed" if isinstance(document, XmlFault) else ""

    @cached_property
    def manifest(self) -> PackageManifest | None:
        """package.xml; None when it is missing or not well-formed."""
        document = self.package.xml("package.xml")
        return read_package_xml(document) if isinstance(document, XmlDocument) else None

    @cached_property
    def config(self) -> ModelConfig | None:
        """model.config; None when it is missing or not well-formed."""
        document = self.package.xml("model.config")
        return read_model_config(document) if isinstance(document, XmlDocument) else None

    @cached_property
    def build(self) -> CMakeFile | None:
        """CMakeLists.txt; None when it is missing or no text."""
        source = self.package.read("CMakeLists.txt")
        return read_cmake(source) if isinstance(source, SourceText) else None
