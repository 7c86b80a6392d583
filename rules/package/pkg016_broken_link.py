"""A symbolic link that is broken or leads out of the package.

The target of the link is not part of the package: after an upload or installation the file is
missing, although it exists on the author's machine. A link into a package that package.xml names as
a dependency is an info: the two are installed together. Virtual environments of Python, folders
with a file `pyvenv.cfg`, are left out. None of the accepted packages that we
checked shows a broken link.

Fix: replace the link with the file itself, or correct the link.
Source: Model Migration Guide, steps 6 and 7: gather all meshes and materials in the package.
"""

import posixpath

from checker.package.index import FileEntry, LinkState
from checker.package.manifests import Paperwork
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule

FAULTS = {
    LinkState.DANGLING: "leads to {}, which does not exist",
    LinkState.OUTSIDE: "leads out of the package, to {}",
    LinkState.SIBLING: "leads into another package, to {}",
    LinkState.LOOP: "leads in a circle, to {}",
}


@rule("PKG016", "broken-link", Severity.ERROR, Concern.PAPERWORK)
def check(package: Package, paperwork: Paperwork) -> Findings:
    """Report links that end outside the package."""
    for link in package.index.links:
        if link.target_state in FAULTS:
            words = FAULTS[link.target_state].format(link.target)
            severity = Severity.INFO if _is_declared(paperwork, link) else None
            yield finding(package.place(link.path), f"link {link.path} {words}", severity=severity)


def _is_declared(paperwork: Paperwork, link: FileEntry) -> bool:
    """Return whether a link leads into a package that this one depends on."""
    if link.target_state is not LinkState.SIBLING or paperwork.manifest is None:
        return False
    steps = posixpath.join(posixpath.dirname(link.path), link.target).split("/")
    return any(paperwork.manifest.depends_on(step) for step in steps)


GOOD = [
    {"meshes/wheel.dae": "<COLLADA/>", "@links": {"meshes/rear_wheel.dae": "wheel.dae"}},
    {"tools/venv/pyvenv.cfg": "version = 3.12\n", "@links": {"tools/venv/lib64": "none"}},
]
BAD = [
    {
        "meshes/wheel.dae": "<COLLADA/>",
        "@links": {"meshes/rear_wheel.dae": "Wheel.dae"},
        "@reported": ["meshes/rear_wheel.dae:1"],
    },
    {
        "../x1_sensor_config_6/package.xml": "<package/>",
        "@links": {"robot.xml": "../x1_sensor_config_6/package.xml", "urdf/all": ".."},
        "@reported": ["robot.xml:1", "urdf/all:1"],
    },
]
