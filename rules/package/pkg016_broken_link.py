"""A symbolic link that is broken or leads out of the package.

The target of the link is not part of the package: after an upload or installation the file is
missing, although it exists on the author's machine. None of the accepted packages that we checked
shows this.

Fix: replace the link with the file itself, or correct the link.
Source: Model Migration Guide, steps 6 and 7: gather all meshes and materials in the package.
"""

from checker.package.index import LinkState
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule

FAULTS = {
    LinkState.DANGLING: "leads to {}, which does not exist",
    LinkState.OUTSIDE: "leads out of the package, to {}",
    LinkState.SIBLING: "leads into another package, to {}",
    LinkState.LOOP: "leads in a circle, to {}",
}


@rule("PKG016", "broken-link", Severity.ERROR, Concern.PAPERWORK)
def check(package: Package) -> Findings:
    """Report links that end outside the package."""
    for link in package.index.links:
        if link.target_state in FAULTS:
            words = FAULTS[link.target_state].format(link.target)
            yield finding(package.place(link.path), f"link {link.path} {words}")


GOOD = [{"meshes/wheel.dae": "<COLLADA/>", "@links": {"meshes/rear_wheel.dae": "wheel.dae"}}]
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
