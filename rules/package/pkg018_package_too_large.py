"""A package, or a file in it, that is very large.

Everyone who starts the robot downloads and loads the whole package; meshes of tens of megabytes
make that slow. No accepted package that we checked has this fault.

Fix: reduce meshes and textures to visible detail, and remove CAD sources.
Source: this rule's own limits; the largest of 18 accepted packages has 10 MB, and its largest file
2 MB.
"""

from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule

MEGABYTE = 1e6
_SHOWN = 3


@rule("PKG018", "package-too-large", Severity.WARNING, Concern.PAPERWORK)
def check(
    package: Package, *, package_megabytes: float = 100.0, file_megabytes: float = 30.0
) -> Findings:
    """Report packages and files that are larger than those of accepted packages.

    Options:
        package_megabytes: Size in MB (10⁶ bytes) that all files of the package may have together;
            more is reported.
        file_megabytes: Size in MB (10⁶ bytes) that a single file may have; more is reported.
    """
    files = sorted(package.index.files, key=lambda file: -file.size)
    total = sum(file.size for file in files) / MEGABYTE
    if total > package_megabytes:
        largest = ", ".join(file.path for file in files[:_SHOWN])
        yield finding(
            package.folder_place(),
            f"the package has {total:.1f} MB, expected at most {package_megabytes:g} MB; its "
            f"largest files are {largest}",
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
