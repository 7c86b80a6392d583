"""A plugin of Nav2 by a name that the ROS 2 distribution does not have.

The server that loads it fails to configure, and the whole of Nav2 does not start. Up to Iron, the
behaviors and several planners are named with a slash (`nav2_behaviors/Spin`), since Jazzy with two
colons (`nav2_behaviors::Spin`). Since Jazzy, bt_navigator loads the libraries of Nav2's behavior
tree nodes by itself: one that `plugin_lib_names` lists as well is registered twice ("ID already
registered"), and bt_navigator fails to configure. So it does with a library that the distribution
does not have ("Could not load library"): one of another distribution's parameter file, or misspelt.
A library `nav2_…` that no distribution has and no CMakeLists.txt of the workspace builds is a
warning: another package may bring it. Libraries of other names may be your own, and are not
checked.

It is reported if the package names its distribution, or `--distro` does. Files whose path names
another distribution are not checked.

Fix: write the name that the message gives; list only your own libraries in `plugin_lib_names`. Or
check for the distribution that the robot runs on (`--distro`).
Source: Nav2 migration guide, Iron to Jazzy; plugin descriptions of navigation2
(`nav2_plugins.json`) and its nav2_behavior_tree/CMakeLists.txt;
ros-navigation/navigation2#3671, #3737 and #4410, about libraries that Humble does not have.
"""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from checker.base.resources import table
from checker.base.words import Suggestions
from checker.model.ros_parameters import NodeBlock
from checker.package.mentions import has_word
from checker.package.package import Package
from checker.ros.wiring.parameters import blocks_in
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, rename, rule
from checker.source.text import Located, SourceText

_LIBRARIES = "plugin_lib_names"
_END = "_bt_node"


@rule("WIR009", "nav2-plugin-not-in-distribution", Severity.ERROR, Concern.INTERFACE)
def check(package: Package, context: Context) -> Findings:
    """Compare the plugins in parameter files of Nav2 with those of the distribution."""
    facts: Mapping[str, Any] = table("nav2_plugins")
    slashed, colons = facts["slash_until"], facts["colons_since"]
    sign = package.distribution_sign
    is_known = context.distro_is_known or (sign is not None and sign.distro == context.distro)
    if not is_known or context.distro not in (*slashed, *colons):
        return
    others = {*slashed, *colons} - {context.distro}
    for file in package.index.with_suffix(".yaml", ".yml"):
        if any(name in file.path.lower() for name in others):
            continue
        for block in blocks_in(package, file.path, "nav2_"):
            yield from _misnamed(block, context.distro)
            yield from _not_built(package, block, context.distro)
            if context.distro in colons:
                yield from _repeated(block, context.distro)


def _misnamed(block: NodeBlock, distro: str) -> Iterator[Finding]:
    """Report names that are written as another distribution has them."""
    facts: Mapping[str, Any] = table("nav2_plugins")
    right, wrong = ("::", "/") if distro in facts["colons_since"] else ("/", "::")
    names = {
        f"{package}{wrong}{plugin}": f"{package}{right}{plugin}"
        for package, plugins in facts["plugins"].items()
        for plugin in plugins
    }
    for name, parameter in block.parameters.items():
        for text in parameter.texts if name.endswith(".plugin") else ():
            if text.value in names:
                yield finding(
                    text,
                    f"{block.node} does not start: {distro.capitalize()} has no plugin "
                    f"{text.value!r}, expected {names[text.value]!r}",
                )


def _not_built(package: Package, block: NodeBlock, distro: str) -> Iterator[Finding]:
    """Report libraries of trees that only another distribution has, or whose names are misspelt."""
    known = _tree_libraries(distro)
    absent = [it for it in _listed(block) if it.value.startswith("nav2_") and it.value not in known]
    names = Suggestions(known)
    for library in absent:
        if _is_own(package, library.value):
            continue
        meant = _near(library.value, known) or names.correction(library.value)
        having = _having(library.value)
        cure = f"did you mean {meant!r}?" if meant else "remove it"
        there = f" ({having} has it)" if having else ""
        of_none = "" if meant or having else ", and no CMakeLists.txt here builds it"
        yield finding(
            library,
            f"bt_navigator does not start: {distro.capitalize()} has no library "
            f"{library.value!r}{there}{of_none}; {cure}",
            severity=Severity.WARNING if of_none else None,
            key=library.value,
            fix=rename(library, meant) if meant else None,
        )


def _near(name: str, known: frozenset[str]) -> str | None:
    """Return a library that differs only in its end: a few have none."""
    others = (name.removesuffix(_END), f"{name}{_END}")
    return next((other for other in others if other != name and other in known), None)


def _having(name: str) -> str:
    """Return the first distribution with a library, "no release" where none has it."""
    for distros, names in table("nav2_plugins")["tree_libraries"].items():
        if name in names:
            return "no release" if distros == "none" else str(distros.split()[0].capitalize())
    return ""


def _is_own(package: Package, name: str) -> bool:
    """Return whether the workspace builds a library, or a Nav2 of its own."""
    builds = (
        holder.read(build.path)
        for holder in (package, *package.other_packages)
        for build in holder.index.with_suffix("cmakelists.txt")
    )
    return package.workspace.package("nav2_behavior_tree") is not None or any(
        isinstance(build, SourceText) and has_word(build.text, name) for build in builds
    )


def _listed(block: NodeBlock) -> Sequence[Located[str]]:
    parameter = block.parameters.get(_LIBRARIES) if block.node == "bt_navigator" else None
    return parameter.texts if parameter is not None else ()


def _tree_libraries(distro: str) -> frozenset[str]:
    groups = table("nav2_plugins")["tree_libraries"].items()
    return frozenset(
        name for distros, names in groups if distro in distros.split() for name in names
    )


def _repeated(block: NodeBlock, distro: str) -> Iterator[Finding]:
    """Report the first library that bt_navigator has loaded already, with the number of all."""
    known = _tree_libraries(distro)
    repeated = [it for it in _listed(block) if it.value in known]
    if repeated:
        more = f" and {len(repeated) - 1} more" if len(repeated) > 1 else ""
        yield finding(
            repeated[0],
            f"bt_navigator does not start: {distro.capitalize()} loads {repeated[0].value}{more} "
            f"by default, and {_LIBRARIES} registers them again: list only your own libraries",
            key=_LIBRARIES,
        )


def _example(plugin: str, libraries: str, mark: str = "", path: str = "nav2") -> dict[str, str]:
    return {
        "@profile": "ros2",
        "README.md": "A rover for ROS 2 Jazzy.\n",
        f"config/{path}.yaml": f"""behavior_server:
  ros__parameters:
    behavior_plugins: [spin]
    spin:
      plugin: "{plugin}"{mark if libraries == _OWN else ""}
bt_navigator:
  ros__parameters:
    plugin_lib_names: [{libraries}]{mark if libraries != _OWN else ""}
""",
    }


_OWN = "acme_dock_bt_node"
_STOCK = "nav2_spin_action_bt_node, nav2_wait_action_bt_node"
_ENDLESS = "nav2_path_expiring_timer_condition"
_HUMBLE = {"@profile": "ros2-classic", "README.md": "A rover for ROS 2 Humble.\n"}
_MARK = "  # ^ WIR009"
GOOD = [
    {**_example("nav2_behaviors/Spin", _STOCK), "README.md": "A rover.\n"},
    _example("nav2_behaviors::Spin", _OWN),
    _example("acme_behaviors/Spin", _OWN),
    _example("nav2_behaviors/Spin", _STOCK, path="nav2_humble"),
    _example("nav2_behaviors/Spin", f"{_ENDLESS}, nav2_rover_bt_node")
    | _HUMBLE
    | {"src/CMakeLists.txt": "add_library(nav2_rover_bt_node SHARED rover.cpp)\n"},
    _example("nav2_behaviors/Spin", f"{_ENDLESS}_bt_node")
    | _HUMBLE
    | {"CMakeLists.txt": f"add_library({_ENDLESS}_bt_node SHARED src/timer.cpp)\n"},
]
BAD = [
    _example("nav2_behaviors/Spin", _OWN, _MARK),
    _example("nav2_behaviors::Spin", _STOCK, _MARK),
    _example("nav2_behaviors/Spin", f"{_ENDLESS}_bt_node", _MARK) | _HUMBLE,
    _example("nav2_behaviors/Spin", "nav2_are_error_codes_active_condition_bt_node", _MARK)
    | _HUMBLE,
    _example("nav2_behaviors::Spin", "nav2_change_goal_node_bt_node", _MARK),
    _example("nav2_behaviors/Spin", f"{_ENDLESS}, nav2_rover_bt_node", _MARK) | _HUMBLE,
]
