"""The names of a package do not agree.

The name of a package is the one in package.xml: catkin and ament find it by that name.
`ament_package()` and `catkin_package()` stop if `project()` in CMakeLists.txt has another one: the
package does not build. The folder may have any name, such as that of an
archive from GitHub (`rover-master`). Only if the folder has the name of a submission to the
challenge (`acme_rover_sensor_config_1`), all names must be equal to it: the SubT launcher builds
the name from it. The names in model.config and `<model name>` are only displayed; a name in plain
words need only state the right number: `Acme Rover Config 2`.

Fix: use the name of package.xml in `project()`; for a submission, the name of the folder in both.
The automatic fix renames all mentions in the package's files. It is not offered if a mention would
be left over: in a file's name, in a longer name or in another package.
Source: REP 140 and catkin: the project name must equal the package name.
"""

from collections.abc import Iterator

from checker.package.inheritance import Found
from checker.package.manifests import Paperwork
from checker.package.package import Package
from checker.package.renaming import package_renamed
from checker.package.submissions import NAME, configuration_number, stated_number
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, rule
from checker.source.cmake import AUTO_PACKAGE, CMakeFile
from checker.source.text import Located
from checker.source.xml import XmlDocument

_COMPARING = (AUTO_PACKAGE, "ament_package", "catkin_package")
"""Commands that stop if the name of the project is not that of the package."""


@rule("PKG002", "names-disagree", Severity.ERROR, Concern.PAPERWORK)
def check(package: Package, paperwork: Paperwork, context: Context) -> Findings:
    """Compare the names in package.xml, CMakeLists.txt and model.config with each other."""
    if package.only:
        return
    manifest, build = paperwork.manifest, paperwork.build
    name, said = package.declared_name, f"package.xml names the package {package.declared_name!r}"
    if context.is_subt and NAME.fullmatch(package.name):
        name, said = package.name, f"its folder is {package.name!r}"
    elif manifest is None or not manifest.name.stated:
        build = None  # Nothing says how the package is called.
    if manifest is not None:
        yield from _compare(package, manifest.name, name, "package.xml names the package", said)
    if build is not None and build.project is not None:
        stops = "" if context.is_subt else _refusal(build)
        if context.is_subt or stops:
            saying = "CMakeLists.txt names the project"
            yield from _compare(package, build.project, name, saying, said + stops)
    if not package.is_urdf:
        shown = paperwork.config.name if paperwork.config is not None else None
        if shown is not None:
            yield from _shown_name(shown, name)
        yield from _model_name(package, name, shown.value if shown is not None else name)


def _refusal(build: CMakeFile) -> str:
    """Return what the build does if its project is not called like the package."""
    if build.project is None or "$" in build.project.value:
        return ""
    call = next(build.calls_of(*_COMPARING), None)
    return f": {call.name}() stops the build" if call is not None else ""


def _compare(
    package: Package, written: Located[str], name: str, saying: str, said: str
) -> Iterator[Finding]:
    if written.stated and written.value != name:
        yield finding(
            written,
            f"{saying} {written.value!r}, but {said}",
            fix=package_renamed(package, written.value, name),
        )


def _shown_name(name: Located[str], package: str) -> Iterator[Finding]:
    """Report another package's name in model.config, and another number in plain words."""
    number = configuration_number(package)
    stated = stated_number(name.value) if " " in name.value and number is not None else number
    if stated not in (None, number):
        yield finding(
            name,
            f"model.config names the model {name.value!r}, but the package is configuration "
            f"{number}",
            severity=Severity.INFO,
        )
    if name.stated and " " not in name.value and name.value != package and "_" in name.value:
        yield finding(
            name,
            f"model.config names the model {name.value!r}, but the package is {package!r}",
            severity=Severity.INFO,
        )


def _model_name(package: Package, called: str, shown: str) -> Iterator[Finding]:
    """The package's own model may have the package's name or that of model.config."""
    path = package.model_path
    document = package.xml(path.path) if isinstance(path, Found) else None
    if not isinstance(document, XmlDocument) or document.source.file.startswith("../"):
        return
    model = document.root.child("model")
    name = model.attribute("name") if model is not None else None
    if name is not None and name.value not in (called, shown):
        yield finding(
            name,
            f"the model is called {name.value!r}, but the package is {called!r}",
            severity=Severity.INFO,
        )


def _manifest(name: str) -> str:
    return f"""<package format="2">
  <name>{name}</name>  <!-- ^ PKG002 -->
</package>
"""


_ROVER = "acme_rover_sensor_config_1"
_BUILD = f"project({_ROVER})\n"

GOOD = [
    {"model.config": "<model><name>Acme Rover</name><sdf>model.sdf</sdf></model>"},
    {"model.config": "<model><name>Acme X2 Sensor Config 1</name><sdf>model.sdf</sdf></model>"},
    # A project of plain CMake may have any name.
    {"@ros2": True, "@profile": "ros2", "CMakeLists.txt": "project(arm_tools)\n"},
    {"@ros2": True, "@profile": "ros2", "CMakeLists.txt": "project(${NAME})\nament_package()\n"},
    {
        "@name": f"{_ROVER} (1)",
        "package.xml": f"<package><name>{_ROVER}</name></package>\n",
        "CMakeLists.txt": _BUILD,
        "model.sdf": f'<sdf version="1.6"><model name="{_ROVER}"/></sdf>\n',
        "model.config": f"<model><name>{_ROVER}</name><sdf>model.sdf</sdf></model>",
    },
]
BAD = [
    {"package.xml": _manifest("acme_rover_sensor_config_2")},
    {"CMakeLists.txt": "project(rover)  # ^ PKG002\n"},
    {
        "model.config": """<model>
  <name>acme_rover_sensor_config_7</name>  <!-- ^ PKG002 -->
  <sdf>model.sdf</sdf>
</model>
"""
    },
    {"model.sdf": '<sdf version="1.6"><model name="rover"/></sdf>  <!-- ^ PKG002 -->\n'},
    {
        "model.config": """<model>
  <name>Acme Rover Sensor Config 2</name>  <!-- ^ PKG002 -->
  <sdf>model.sdf</sdf>
</model>
"""
    },
    {
        "@name": "rover-master",
        "package.xml": "<package><name>acme_rover</name></package>\n",
        "CMakeLists.txt": "project(rover-master)  # ^ PKG002\ncatkin_package()\n",
        "model.config": None,
        "model.sdf": '<sdf version="1.6"><model name="acme_rover"/></sdf>\n',
    },
    {
        "@ros2": True,
        "@profile": "ros2",
        "CMakeLists.txt": "project(arm_tools)  # ^ PKG002\nament_package()\n",
    },
    {
        "@urdf": True,
        "@profile": "urdf",
        "CMakeLists.txt": "project(arm_tools)  # ^ PKG002\ncatkin_package()\n",
    },
]
