"""ros2_control of one robot: hardware, what runs the controller manager, controllers."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property
from typing import TYPE_CHECKING

from checker.base.files import NotReadable
from checker.base.record import Record
from checker.base.words import Suggestions
from checker.formats.urdf.description import UrdfDescription
from checker.formats.xacro.files import ROOT, local_path, package_in
from checker.launch.ros2.package_files import local_file
from checker.model.components import Joint, Plugin
from checker.model.controllers import Controller, ControllerFile, controllers_of
from checker.model.plugin_library import library_stem
from checker.model.robot import Robot
from checker.model.ros_parameters import (
    MANAGER,
    PARAMETERS,
    bare_managers,
    read_blocks,
    refused_value,
)
from checker.package.package import Package
from checker.package.uris import is_on_one_machine, uri_of_installed, uri_of_machine
from checker.ros.ros2_control.hardware import Hardware, HardwareJoint, read_hardware
from checker.source.text import Located, SourceText, Span

if TYPE_CHECKING:
    from checker.source.yaml import YamlFault, YamlNode

MAX_FILES = 200
"""YAML files of a package that are read though no plugin names them."""
MAX_VALUES = 200_000
"""Values of all YAML files of a package together."""
_LIBRARY = "ros2_control"
_FIND = re.compile(r"\$\(find(?:-pkg-share)?\s{1,8}([\w.-]{1,200})\s{0,8}\)")


class ParametersFile(Record, eq=False):
    """A file of parameters that a Gazebo plugin names.

    Attributes:
        text: What the plugin states.
        package: Name of the package that it is in; empty if that is not known.
        path: The path as the checked package lists it; None if no such package is available.
        exists: Whether the file is there.
    """

    text: Located[str]
    package: str
    path: str | None
    exists: bool


class GazeboManager(Record, eq=False):
    """A Gazebo plugin that runs a controller manager.

    Attributes:
        plugin: The plugin.
        files: What its `<parameters>` name.
        namespace: Absolute; `/` when it states none.
        node: Name of the manager's node.
    """

    plugin: Plugin
    files: tuple[ParametersFile, ...]
    namespace: Located[str]
    node: str = MANAGER

    @property
    def span(self) -> Span:
        """The start tag."""
        return self.plugin.span

    @property
    def library(self) -> str:
        """Name of its library: `gz_ros2_control-system`, `gazebo_ros2_control`."""
        return library_stem(self.plugin.filename.value)


class PluginFiles(Record, eq=False):
    """Files of parameters that the Gazebo plugins of one robot name.

    Attributes:
        robot: The robot that has the plugins.
        managers: Plugins that run a controller manager.
        files: What of their files can be read.
        faults: What is wrong with them as YAML.
        unread: The reasons why parameters are not known, each the end of a sentence.
    """

    robot: Robot
    managers: tuple[GazeboManager, ...]
    files: tuple[ControllerFile, ...]
    faults: tuple[YamlFault, ...]
    unread: tuple[str, ...]


class ConfiguredControllers(Record, eq=False, dict=True):
    """The controllers that files of parameters configure.

    Attributes:
        files: The files.
        robot: The robot that they move; None if it cannot be read, and launch files name the files.
    """

    files: tuple[ControllerFile, ...]
    robot: Robot | None = None

    @cached_property
    def controllers(self) -> tuple[Controller, ...]:
        """Controllers in the files."""
        return controllers_of(self.files)


class RobotControl(Record, eq=False, dict=True):
    """ros2_control of one robot.

    Attributes:
        robot: The robot, without its meshes.
        hardware: Its `<ros2_control>` tags.
        managers: Plugins of Gazebo that run a controller manager.
        files: Files of parameters that are about its controllers.
        unread: The reasons why parameters are not known, each the end of a sentence.
        by_default: Whether the robot is the one that its file makes without further values.
        beside: Controllers that another package configures for the only robot of its package.
    """

    robot: Robot
    hardware: tuple[Hardware, ...]
    managers: tuple[GazeboManager, ...] = ()
    files: tuple[ControllerFile, ...] = ()
    unread: tuple[str, ...] = ()
    by_default: bool = True
    beside: tuple[Controller, ...] = ()

    @property
    def is_named(self) -> bool:
        """True if a plugin or launch file names the files, which are then certainly its own."""
        return any(file.loaded_by is not None for file in self.files)

    @property
    def has_variants(self) -> bool:
        """True if the files may be for variants of the robot: the loaded one is not known."""
        return not self.is_named and len(self.files) > 1

    @cached_property
    def configured(self) -> ConfiguredControllers:
        """What the files configure."""
        return ConfiguredControllers(self.files, self.robot)

    @property
    def controllers(self) -> tuple[Controller, ...]:
        """Controllers in the files."""
        return self.configured.controllers

    @cached_property
    def joints(self) -> Mapping[str, HardwareJoint]:
        """Joints of its hardware by name; the first one when a name is given twice."""
        every = [joint for hardware in self.hardware for joint in hardware.joints]
        return {joint.name.value: joint for joint in reversed(every)}

    def joint(self, joint: HardwareJoint) -> Joint | None:
        """Return the joint of the robot that one of the hardware represents."""
        return self.robot.joints_by_name.get(joint.name.value)

    def may_be_included(self, joint: Located[str]) -> bool:
        """Return whether what is not available may have a joint, which is not misspelt."""
        if not self.robot.may_be_included(joint.value):
            return False
        return Suggestions(self.robot.joints_by_name).correction(joint.value) is None

    @cached_property
    def components(self) -> frozenset[str]:
        """Names of all joints, sensors and gpios of its hardware."""
        return frozenset(
            part.name.value
            for hardware in self.hardware
            for part in (*hardware.joints, *hardware.sensors, *hardware.gpios)
        )


# Which files of parameters belong to a robot, and reading them.


class ControlReader:
    """Reads ros2_control of the robots of a package; each YAML file is parsed once."""

    def __init__(self, package: Package, launched: Mapping[str, Span] | None = None) -> None:
        """Begin with nothing read.

        Args:
            package: The package of the robots.
            launched: Files of parameters that its launch files name, each with what names it.
        """
        self.package = package
        self.launched = launched or {}
        self._read: dict[str, tuple[YamlNode | None, tuple[YamlFault, ...], str]] = {}
        self._values = 0

    def control(self, description: UrdfDescription) -> RobotControl | None:
        """Return ros2_control of a robot; None if it has none."""
        robot = description.robot
        hardware = read_hardware(description.document.root)
        named = self.plugin_files(robot)
        managers = named.managers
        if not hardware and not managers:
            return None
        mere = RobotControl(robot, hardware, managers)
        # A file that is named and not there is a fault of its own, and no other one replaces it.
        guesses = not any(manager.files for manager in managers)
        files = self._likely(mere.components) if guesses else named.files
        default = not description.values
        return RobotControl(robot, hardware, managers, files, named.unread, default)

    def plugin_files(self, robot: Robot) -> PluginFiles:
        """Return the files of parameters that the Gazebo plugins of a robot name."""
        managers = tuple(map(self._manager, filter(runs_manager, robot.plugins)))
        faults: list[YamlFault] = []
        unread: list[str] = []
        files = tuple(self._plugin_files(managers, faults, unread))
        return PluginFiles(robot, managers, files, tuple(faults), tuple(unread))

    def _manager(self, plugin: Plugin) -> GazeboManager:
        files = tuple(self._parameters_file(text) for text in plugin.at("parameters"))
        stated = next((text for text in plugin.at("ros/namespace")), None)
        namespace = Located("/", plugin.span, stated=False)
        if stated is not None:
            namespace = Located(f"/{stated.value.strip('/')}", stated.span)
        node = next((text.value for text in plugin.at("controller_manager_name")), MANAGER)
        return GazeboManager(plugin, files, namespace, node)

    def _parameters_file(self, text: Located[str]) -> ParametersFile:
        stated = text.value.strip()
        uri = uri_of_installed(stated)
        if not uri and is_on_one_machine(stated):
            uri = uri_of_machine(self.package, stated)
        path = _FIND.sub(rf"{ROOT}/\1", uri or stated)
        path = re.sub(r"\Apackage://(?!/)", f"{ROOT}/", path).removeprefix("file://")
        local = local_path(self.package, path)
        # A file with a slash behind its name is not found: only a folder may have one.
        exists = local is not None and self.package.exists(local) and not path.endswith("/")
        return ParametersFile(text, package_in(path), local, exists)

    def _plugin_files(
        self, managers: Iterable[GazeboManager], faults: list[YamlFault], unread: list[str]
    ) -> Iterator[ControllerFile]:
        """Yield the files that Gazebo plugins name."""
        for file in (file for manager in managers for file in manager.files):
            if file.path is not None and file.exists:
                root, found, reason = self._yaml(file.path)
                faults += found
                if reason:
                    unread.append(reason)
                if root is not None:
                    blocks, bare = tuple(read_blocks(root)), tuple(bare_managers(root))
                    yield ControllerFile(file.path, blocks, file.text.span, bare)

    def _likely(self, names: frozenset[str]) -> tuple[ControllerFile, ...]:
        """Return the files that launch files name, else those that are in the package."""
        launched = tuple(self._mentioning(self.launched, names))
        index = self.package.index.with_suffix(".yaml", ".yml")[:MAX_FILES]
        paths = [entry.path for entry in index if not entry.is_of_tests]
        return launched or tuple(self._mentioning(paths, names))

    def controllers_beside(self, control: RobotControl) -> tuple[Controller, ...]:
        """Return the controllers of a robot that one other package configures, each in one file.

        A robot whose description names its file of parameters has those alone, and so have robots
        whose own package launches controllers.
        """
        if self.package.only or self.launched or any(manager.files for manager in control.managers):
            return ()
        names = control.components
        beside = (
            tuple(self._mentioning(self._beside(other, names), names))
            for other in self.package.other_packages
        )
        found = [files for files in beside if files]
        if len(found) != 1:
            return ()
        controllers = controllers_of(found[0])
        # Of several files for one controller, a launch file chooses.
        several = sum(len(controllers_of([file])) for file in found[0]) > len(controllers)
        return () if several else controllers

    def _beside(self, other: Package, names: frozenset[str]) -> Iterator[str]:
        """Yield the files of another package that may configure these joints."""
        for entry in other.index.with_suffix(".yaml", ".yml")[:MAX_FILES]:
            path = f"../{other.root.name}/{entry.path}"
            source = None if entry.is_of_tests else self.package.read(path)
            text = source.text if isinstance(source, SourceText) else ""
            if PARAMETERS in text and any(name in text for name in names):
                yield path

    def _mentioning(self, paths: Iterable[str], names: frozenset[str]) -> Iterator[ControllerFile]:
        """Yield those of the files that configure a controller of these joints."""
        for path in paths:
            root, _, _ = self._yaml(path)
            if root is None:
                continue
            file = ControllerFile(path, tuple(read_blocks(root)), self.launched.get(path))
            if any(_mentions(controller, names) for controller in controllers_of([file])):
                yield file

    def launched_files(self) -> Iterator[ControllerFile]:
        """Yield the files of the package that its launch files give to managers and spawners."""
        for path, span in self.launched.items():
            root = None if path.startswith("../") else self._yaml(path)[0]
            if root is not None:
                yield ControllerFile(path, tuple(read_blocks(root)), span)

    def file(self, path: str) -> ControllerFile | None:
        """Return the file at a path as xacro and launch see it; None if it cannot be had."""
        local = local_file(self.package, path)
        root = self._yaml(local)[0] if local is not None else None
        if local is None or root is None:
            return None
        return ControllerFile(local, tuple(read_blocks(root)), refused=refused_value(root))

    def _yaml(self, path: str) -> tuple[YamlNode | None, tuple[YamlFault, ...], str]:
        if path not in self._read:
            self._read[path] = self._parsed(path)
        return self._read[path]

    def _parsed(self, path: str) -> tuple[YamlNode | None, tuple[YamlFault, ...], str]:
        # The library is loaded for those packages only that have such files.
        from checker.source.yaml import read_yaml

        source = self.package.read(path)
        if isinstance(source, NotReadable):
            return None, (), f"{path} {source.reason}"
        if self._values > MAX_VALUES:
            return (
                None,
                (),
                f"{path} is not read: the parameters have more than {MAX_VALUES} values",
            )
        document = read_yaml(source)
        self._values += document.root.size if document.root is not None else 0
        return document.root, document.faults, ""


def may_be_controlled(description: UrdfDescription) -> bool:
    """Return whether a robot has a `<ros2_control>` tag, or a plugin that runs a manager."""
    root = description.document.root
    return root.child("ros2_control") is not None or any(
        map(runs_manager, description.robot.plugins)
    )


def runs_manager(plugin: Plugin) -> bool:
    """Return whether a plugin of Gazebo runs a controller manager."""
    return _LIBRARY in library_stem(plugin.filename.value)


def _mentions(controller: Controller, names: frozenset[str]) -> bool:
    return any(
        text.value in names
        for parameter in controller.parameters.values()
        for text in parameter.texts
    )
