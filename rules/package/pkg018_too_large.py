"""A package, or a file in it, that is very large.

Every run in the cloud loads the packages of all robots of a team; meshes of tens of megabytes make
the start slow and fill the memory of the graphics card. No accepted package at hand shows it.

Fix: reduce the meshes to what can be seen (some ten thousand triangles), save textures with at most
2048 × 2048 pixels, and leave out sources of CAD programs.
Source: accepted packages: all stay below 30 MB in one file and 100 MB in all.
"""

from checker.package.package import Package
from checker.rule import Findings, Severity, finding, rule

MEGABYTE = 1e6
_SHOWN = 3


@rule("PKG018", "too-large", Severity.WARNING)
def check(
    package: Package, *, package_megabytes: float = 100, file_megabytes: float = 30
) -> Findings:
    """Report what is larger than accepted packages are; 1 MB is 10⁶ bytes."""
    files = sorted(package.index.files, key=lambda file: -file.size)
    total = sum(file.size for file in files) / MEGABYTE
    if total > package_megabytes:
        largest = ", ".join(file.path for file in files[:_SHOWN])
        yield finding(
            package.folder_place(),
            f"package has {total:.1f} MB, expected at most {package_megabytes:g} MB; "
            f"its largest files are {largest}",
            key="package",
        )
    for file in files:
        if file.size / MEGABYTE > file_megabytes:
            yield finding(
                package.place(file.path),
                f"{file.path} has {file.size / MEGABYTE:.1f} MB, "
                f"expected at most {file_megabytes:g} MB",
            )


GOOD = [{"meshes/wheel.dae": "<COLLADA/>"}]
BAD = [{"meshes/wheel.stl": bytes(30_500_000), "@reported": ["meshes/wheel.stl:1"]}]
