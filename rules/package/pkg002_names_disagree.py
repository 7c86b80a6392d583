"""The names of a package do not agree.

catkin finds a package by the name in package.xml, CMake installs it under the name of `project()`,
and the SubT launcher uses the folder's name. If they differ, `roslaunch` does not find the package.
The names in model.config and `<model name>` are only displayed; a name in plain words need only
state the right number: `Acme Rover Config 2`. The folder of a URDF package may have any name: no
launcher builds one from it.

Fix: use the same name in package.xml, `project()` and for the folder.
Source: REP 140 and catkin: the project name must equal the package name.
"""

from collections.abc import Iterator

from checker.package.inheritance import Found
from checker.package.kind import PackageKind
from checker.package.manifests import Paperwork
from checker.package.package import Package
from checker.package.submissions import configuration_number, stated_number
from checker.rule import Concern, Finding, Findings, Severity, finding, replace_text, rule
from checker.source.text import Located
from checker.source.xml import XmlDocument


@rule("PKG002", "names-disagree", Severity.ERROR, Concern.PAPERWORK)
def check(package: Package, paperwork: Paperwork) -> Findings:
    """Compare the names in package.xml, CMakeLists.txt and model.config with the folder's."""
    if package.only:
        return
    manifest, build = paperwork.manifest, paperwork.build
    if package.kind is PackageKind.URDF_DESCRIPTION:
        if manifest is not None and build is not None and build.project is not None:
            yield from _project(build.project, manifest.name)
        return
    if manifest is not None:
        yield from _compare(manifest.name, package.name, "package.xml names the package")
    if build is not None and build.project is not None:
        yield from _compare(build.project, package.name, "CMakeLists.txt names the project")
    shown = paperwork.config.name if paperwork.config is not None else None
    if shown is not None:
        yield from _shown_name(shown, package.name)
    yield from _model_name(package, shown.value if shown is not None else package.name)


def _compare(name: Located[str], folder: str, saying: str) -> Iterator[Finding]:
    if name.stated and name.value != folder:
        yield finding(
            name,
            f"{saying} {name.value!r}, but its folder is {folder!r}",
            fix=replace_text(name, folder),
        )


def _project(project: Located[str], name: Located[str]) -> Iterator[Finding]:
    if project.stated and name.stated and project.value != name.value:
        yield finding(
            project,
            f"CMakeLists.txt names the project {project.value!r}, but package.xml names the "
            f"package {name.value!r}",
            fix=replace_text(project, name.value),
        )


def _shown_name(name: Located[str], folder: str) -> Iterator[Finding]:
    """Report another package's name in model.config, and another number in plain words."""
    number = configuration_number(folder)
    stated = stated_number(name.value) if " " in name.value and number is not None else number
    if stated not in (None, number):
        yield finding(
            name,
            f"model.config names the model {name.value!r}, but the package is configuration "
            f"{number}",
            severity=Severity.INFO,
        )
    if name.stated and " " not in name.value and name.value != folder and "_" in name.value:
        yield finding(
            name,
            f"model.config names the model {name.value!r}, but the folder is {folder!r}",
            severity=Severity.INFO,
        )


def _model_name(package: Package, shown: str) -> Iterator[Finding]:
    """The package's own model may have the folder's name or that of model.config."""
    path = package.model_path
    document = package.xml(path.path) if isinstance(path, Found) else None
    if not isinstance(document, XmlDocument) or document.source.file.startswith("../"):
        return
    model = document.root.child("model")
    name = model.attribute("name") if model is not None else None
    if name is not None and name.value not in (package.name, shown):
        yield finding(
            name,
            f"the model is called {name.value!r}, but the package is {package.name!r}",
            severity=Severity.INFO,
        )


def _manifest(name: str) -> str:
    return f"""<package format="2">
  <name>{name}</name>  <!-- ^ PKG002 -->
</package>
"""


GOOD = [
    {"model.config": "<model><name>Acme Rover</name><sdf>model.sdf</sdf></model>"},
    {"model.config": "<model><name>Acme X2 Sensor Config 1</name><sdf>model.sdf</sdf></model>"},
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
]
