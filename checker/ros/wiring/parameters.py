"""The parameters that a node gets: from files and from the launch file, by the rules of rcl."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from checker.base.record import Record
from checker.launch.ros2.graph import Node, NodeKind, Parameter, ParameterFile, is_known
from checker.model.ros_parameters import NodeBlock, read_blocks
from checker.model.ros_parameters import Parameter as FileParameter
from checker.package.package import Package
from checker.source.text import SourceText, Span

_EVERY = "/**"
_UNKNOWN = "$("


class Setting(Record, eq=False):
    """The value of a parameter.

    Attributes:
        value: Text, number, truth value, list or mapping.
        span: The value where it is written.
    """

    value: object
    span: Span

    @property
    def text(self) -> str | None:
        """The value as text, truth values in small letters; None if it is not known."""
        text = str(self.value)
        if isinstance(self.value, bool):
            return text.lower()
        return text if is_known(text) else None


class LoadedFile(Record, eq=False):
    """A parameter file that a node is given.

    Attributes:
        given: The place where the launch file names it.
        path: The path as the package lists it; empty if it is not available.
        blocks: What it gives to which nodes; none if it cannot be read.
        is_read: Whether it could be read.
        refused: The key for whose value rcl refuses the file, if there is one.
    """

    given: ParameterFile
    path: str = ""
    blocks: tuple[NodeBlock, ...] = ()
    is_read: bool = False
    refused: Span | None = None

    @property
    def names(self) -> tuple[str, ...]:
        """Names that its blocks are for."""
        return tuple(dict.fromkeys(block.name for block in self.blocks))


def blocks_in(package: Package, path: str, word: str) -> Iterator[NodeBlock]:
    """Yield the blocks of a parameter file, if it contains a word.

    Args:
        package: The package being checked.
        path: The file as the package lists it.
        word: What a file without it is not read for.
    """
    source = package.read(path)
    if isinstance(source, SourceText) and word in source.text:
        from checker.source.yaml import read_yaml

        root = read_yaml(source).root
        yield from read_blocks(root) if root is not None else ()


def settings_of(
    node: Node, files: Iterable[LoadedFile], name: str, namespace: str
) -> Mapping[str, Setting]:
    """Return the parameters of a node, those that count.

    rcl joins all files by the keys of their blocks, each at the place where it comes first, and a
    later block counts. launch writes the parameters of a launch file into a block for every node
    too, unless the node has its own name and namespace. To a component launch hands all
    parameters in order.

    Args:
        node: The node that gets them.
        files: Its parameter files.
        name: The name of the node.
        namespace: Absolute.
    """
    by_given = {id(file.given): file for file in files}
    blocks: dict[str, dict[str, Setting]] = {}
    own = "" if node.name is not None and namespace != "/" else _EVERY
    for parameter in node.parameters:
        if isinstance(parameter, Parameter):
            setting = Setting(parameter.value, parameter.span)
            blocks.setdefault(own, {})[parameter.name] = setting
        elif (file := by_given.get(id(parameter))) is not None:
            for block in file.blocks:
                if block.is_for(name, namespace):
                    key = own if node.kind is NodeKind.COMPONENT else block.name
                    blocks.setdefault(key, {}).update(_settings(block, file.given))
    return {name: setting for block in blocks.values() for name, setting in block.items()}


def _settings(block: NodeBlock, given: ParameterFile) -> dict[str, Setting]:
    return {
        name: Setting(_value(parameter, given), parameter.span)
        for name, parameter in block.parameters.items()
    }


def _value(parameter: FileParameter, given: ParameterFile) -> object:
    """Return a value of a file as the node gets it: with what `ReplaceString` writes into it."""
    source, start = parameter.key.source, parameter.key.start
    written = text = source.text[start : parameter.span.end]
    for old, new in given.replacements:
        text = text.replace(old, new)
    if text == written:
        return parameter.node.plain() if parameter.is_known else _UNKNOWN
    from checker.source.yaml import read_yaml

    root = read_yaml(SourceText(source.file, text)).root
    values = [value.plain() for _, value in root.entries] if root is not None else []
    return values[0] if values else _UNKNOWN
