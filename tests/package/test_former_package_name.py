"""`package://` with the name of a package that does not exist, for files of this package."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.pipeline import check_package
from checker.rule_testing import write_example
from checker.settings import Settings
from rules.references import ref002_file_not_found as ref002


@pytest.mark.parametrize(
    ("named", "declared", "cloned", "is_reported"),
    [
        ("old_arm/shapes", "", ("arm",), True),
        ("old_arm/shapes", "", ("arm", "arm_parts"), False),  # one of them may have it
        ("old_arm/meshes", "", (), False),  # this package has no such file
        ("old_arm/shapes", "<exec_depend>old_arm</exec_depend>", (), False),
        ("ur_description/shapes", "", (), False),  # ROS distributions have it
    ],
)
def test_only_a_package_that_exists_nowhere_is_reported(
    named: str, declared: str, cloned: tuple[str, ...], is_reported: bool, tmp_path: Path
) -> None:
    readme = "".join(f"    git clone https://example.org/acme/{name}.git\n" for name in cloned)
    arm = {**ref002._ARM, "README.md": readme}
    manifest = str(arm["package.xml"]).replace("<export>", f"{declared}<export>")
    urdf = str(arm["urdf/arm.urdf"]).replace("acme_arm/shapes", named)
    package = write_example({**arm, "package.xml": manifest, "urdf/arm.urdf": urdf}, tmp_path)
    (report,) = check_package(package, Settings(trial=False)).packages
    found = [it for it in report.findings if it.rule == "REF002"]
    assert bool(found) == is_reported
    assert all("write package://acme_arm/shapes/arm.dae" in it.message for it in found)
