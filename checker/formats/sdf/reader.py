"""A whole SDF file: the models in it, with nested models and includes laid out flat."""

from __future__ import annotations

from dataclasses import dataclass, field

from msgspec.structs import replace

from checker.formats.sdf.conventions import CONVENTIONS
from checker.formats.sdf.document import sdf_version
from checker.formats.sdf.frame_faults import unknown_frames
from checker.formats.sdf.includes import IncludeReader, included_model, read_no_include
from checker.formats.sdf.links import read_frame, read_joint, read_link, read_plugin
from checker.formats.sdf.names import KINDS, name_of, renames_of
from checker.formats.sdf.scope import Scope
from checker.model.components import Frame, Joint, Link, Model, Plugin
from checker.model.faults import FaultKind
from checker.model.frames import MODEL_FRAME, FrameGraph, FrameNode
from checker.model.geometry.transform import Transform
from checker.model.robot import Robot
from checker.model.values import ValueReader
from checker.source.text import Located
from checker.source.xml import Element, XmlDocument

MAX_NESTING = 40
MAX_INCLUDES = 100
"""Limit for one robot in all: files that include one another twice would double at each level."""


def read_sdf(document: XmlDocument, include: IncludeReader = read_no_include) -> tuple[Robot, ...]:
    """Read the models that are at the top of a file or directly in its worlds.

    A model that is included at the top is the file's own; what worlds include is not.
    """
    root = document.root
    holders = [root, *root.all("world")]
    if root.tag == "world":
        holders = [root]
    models = [model for holder in holders for model in holder.all("model")]
    if root.tag == "model":
        models = [root]
    robots = [read_robot(model, include) for model in models]
    included = [(each, included_model(each, include)) for each in root.all("include")]
    robots += [
        read_robot(model, include, placed)
        for placed, model in included
        if isinstance(model, Element) and root.tag == "sdf"
    ]
    return tuple(robots)


def read_robot(
    element: Element, include: IncludeReader = read_no_include, placed: Element | None = None
) -> Robot:
    """Read one `<model>` as a separate robot; an include places it and may rename it."""
    document = element.document
    values, graph = ValueReader(), FrameGraph()
    version = sdf_version(document)
    scope = Scope("", MODEL_FRAME, version, values, graph, renames_of(element, version))
    pose = scope.pose(element if placed is None else _posing(element, placed))
    graph.add(MODEL_FRAME, FrameNode(None, Transform(), pose.span, "the model"))
    collected = _Collected(include, [document])
    collected.read(element, scope, 0)
    if placed is not None:
        collected.plugins.extend(read_plugin(plugin) for plugin in placed.all("plugin"))
    robot = Robot(
        values.name(element) if placed is None else _name_of(element, placed, scope),
        element,
        document,
        "sdf",
        CONVENTIONS,
        document.root.get("version") or "",
        pose,
        tuple(collected.links),
        tuple(collected.joints),
        tuple(collected.frames),
        tuple(collected.models),
        tuple(collected.plugins),
        graph,
        unresolved_includes=tuple(collected.unresolved),
        merges_unknown=collected.merges_unknown,
    )
    for name in graph.nodes:
        graph.pose(name)
    return replace(robot, faults=(*values.faults, *graph.faults, *unknown_frames(robot)))


@dataclass
class _Collected:
    """The parts of a robot while it is being read."""

    include: IncludeReader
    open_files: list[XmlDocument]
    includes: int = 0
    links: list[Link] = field(default_factory=list)
    joints: list[Joint] = field(default_factory=list)
    frames: list[Frame] = field(default_factory=list)
    models: list[Model] = field(default_factory=list)
    plugins: list[Plugin] = field(default_factory=list)
    unresolved: list[Located[str]] = field(default_factory=list)
    merges_unknown: bool = False
    merging: list[Element] = field(default_factory=list)
    entered: dict[str, tuple[Element | None, Element | None]] = field(default_factory=dict)

    def read(self, model: Element, scope: Scope, depth: int) -> None:
        """Read the inside of a model."""
        # Joints come last: where one has the name of a link, the name represents the link.
        for child in sorted(model.children, key=lambda child: child.tag == "joint"):
            match child.tag:
                case "link":
                    self.links.append(read_link(child, scope))
                case "joint":
                    self.joints.append(read_joint(child, scope))
                case "frame":
                    self.frames.append(read_frame(child, scope))
                case "plugin":
                    self.plugins.append(read_plugin(child, scope.prefix.removesuffix("::")))
                case "model":
                    self._read_nested(child, child, scope, depth + 1)
                case "include":
                    self._read_include(child, scope, depth + 1)
            if child.tag in KINDS:
                self._enter(child, scope)

    def _enter(self, part: Element, scope: Scope) -> None:
        """Remember a name; one of two models that is given twice comes by a merge."""
        name = scope.prefix + (scope.renamed.get(part) or name_of(part))
        merge = self.merging[-1] if self.merging else None
        parent, earlier = self.entered.setdefault(name, (part.parent, merge))
        at = merge or earlier
        elsewhere = parent is not part.parent or earlier is not merge
        if elsewhere and at is not None and name != scope.prefix:
            message = f"contains {part.tag} {name!r}, but another part has this name"
            scope.values.fault(FaultKind.INCLUDE, at.span, f"the merged model {message}")

    def _read_include(self, include: Element, scope: Scope, depth: int) -> None:
        uri = scope.values.text(include, "uri")
        document = self.include(uri) if uri.stated else "an <include> without <uri>"
        if isinstance(document, str):
            self.unresolved.append(uri)
            self.merges_unknown |= _merges(include)
            return
        self.includes += 1
        model = next(iter(document.root.all("model")), None)
        if include.child("placement_frame") is not None and include.child("pose") is None:
            message = f"{uri.value} is placed by one of its frames, but the include has no <pose>"
            scope.values.fault(FaultKind.INCLUDE, uri.span, message)
        if refusal := self._refusal(document, model):
            scope.values.fault(FaultKind.INCLUDE, uri.span, f"{uri.value} {refusal}")
        elif model is not None:
            self.open_files.append(document)
            self.merging += [include] if _merges(include) else []
            self._read_nested(model, include, scope, depth, uri)
            self.open_files.pop()
            if _merges(include):
                self.merging.pop()

    def _refusal(self, document: XmlDocument, model: Element | None) -> str:
        """Return the reason why an include is not read; empty if it is."""
        if model is None:
            return "contains no <model>"
        if document in self.open_files:
            return "includes itself"
        if self.includes > MAX_INCLUDES:
            return f"is one of more than {MAX_INCLUDES} includes"
        return ""

    def _read_nested(
        self,
        model: Element,
        placed: Element,
        scope: Scope,
        depth: int,
        included_from: Located[str] | None = None,
    ) -> None:
        """Read a model inside another; `placed` is the element that poses and names it."""
        if depth > MAX_NESTING:
            message = f"models are nested more than {MAX_NESTING} levels deep"
            scope.values.fault(FaultKind.INCLUDE, placed.span, message)
            return
        name = _name_of(model, placed, scope)
        inside = self._scope_inside(model, placed, name.value, scope)
        pose = scope.pose(_posing(model, placed))
        self.read(model, inside, depth)
        if placed is not model:
            names = inside.prefix.removesuffix("::")
            self.plugins.extend(read_plugin(child, names) for child in placed.all("plugin"))
        transform = pose.transform @ _placement(model, placed, inside)
        node = FrameNode(
            pose.relative_to or scope.model_frame, transform, pose.span, f"model '{name.value}'"
        )
        inside.graph.add(inside.model_frame, node)
        self.models.append(
            Model(
                name,
                placed,
                inside.model_frame,
                pose,
                model,
                scope.prefix,
                inside.prefix,
                included_from,
            )
        )

    @staticmethod
    def _scope_inside(model: Element, placed: Element, name: str, scope: Scope) -> Scope:
        """Return the scope of a nested model; a merged one (SDF 1.9) shares its parent's names."""
        version = sdf_version(model.document)
        new_names = renames_of(model, version)
        if _merges(placed):
            frame = f"{scope.prefix}_merged__{name}__model__"
            return Scope(scope.prefix, frame, version, scope.values, scope.graph, new_names)
        frame = scope.scoped(name)
        return Scope(f"{frame}::", frame, version, scope.values, scope.graph, new_names)


def _merges(include: Element) -> bool:
    """Return whether an include merges its parts into the model around it, as from SDF 1.9 on."""
    return (include.get("merge") or "").lower() in ("true", "1")


def _posing(model: Element, placed: Element) -> Element:
    """Return the element whose pose places a model: that of an include comes first."""
    return placed if placed.child("pose") is not None else model


def _name_of(model: Element, placed: Element, scope: Scope) -> Located[str]:
    """Return the name of a nested model: an include may give it another one."""
    if placed is not model and (name := scope.values.text(placed, "name")).stated:
        return name
    return scope.values.name(model)


def _placement(model: Element, placed: Element, inside: Scope) -> Transform:
    """Return the model's frame in its placement frame (SDF 1.8), which `<pose>` then places."""
    stated = placed.child("placement_frame") if placed is not model else None
    frame = stated.text.value if stated is not None else model.get("placement_frame")
    if not frame:
        return Transform()
    pose = inside.graph.pose_below(inside.scoped(frame), inside.model_frame)
    if pose is None:
        message = f"placement frame {frame!r} does not exist in the model"
        inside.values.fault(FaultKind.FRAME, placed.span, message)
        return Transform()
    return pose.inverse
