"""How severe too large an inertia is: of placeholders, objects, and links of one formula."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.finding import Severity
from checker.pipeline import check_package
from checker.settings import Settings

MODEL = """<sdf version="1.9"><model name="rope">
<link name="a">
  <inertial><mass>{mass}</mass>
    <inertia><ixx>{ixx}</ixx><iyy>0.001</iyy><izz>0.001</izz></inertia></inertial>
  <collision name="c"><geometry><sphere><radius>0.05</radius></sphere></geometry></collision>
</link>
<link name="b"><inertial><mass>0.05</mass></inertial></link>
<joint name="j" type="revolute">
  <parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz></axis></joint>
</model></sdf>
"""


@pytest.mark.parametrize(
    ("mass", "ixx", "severity"),
    [
        (0.01, 0.001, Severity.WARNING),
        (0.009, 0.001, Severity.ERROR),
        (0.01, 0.0015, Severity.ERROR),
        (0.1, 0.001, Severity.ERROR),
    ],
)
def test_severity(tmp_path: Path, mass: float, ixx: float, severity: Severity) -> None:
    (tmp_path / "rope.sdf").write_text(MODEL.format(mass=mass, ixx=ixx))
    settings = Settings(trial=False, select=("INE004",), profile="subt", profile_chosen=True)
    (report,) = check_package(tmp_path / "rope.sdf", settings).packages
    found = [it for it in report.findings if "'a'" in it.message]
    assert [finding.severity for finding in found] == [severity]


@pytest.mark.parametrize(("ixx", "severity"), [(0.01, Severity.INFO), (1.0, Severity.WARNING)])
def test_an_object_is_a_warning_if_it_is_far_too_large(
    tmp_path: Path, ixx: float, severity: Severity
) -> None:
    text = MODEL.format(mass=1, ixx=ixx).replace("0.001", str(ixx)).replace("revolute", "fixed")
    (tmp_path / "rope.sdf").write_text(text)
    settings = Settings(trial=False, select=("INE004",), profile="gazebo-harmonic")
    (report,) = check_package(tmp_path / "rope.sdf", settings).packages
    found = [it for it in report.findings if "'a'" in it.message]
    assert [finding.severity for finding in found] == [severity]


LINK = """<link name="{name}">
  <inertial><mass>{mass}</mass>
    <inertia><ixx>{moment}</ixx><iyy>{moment}</iyy><izz>{moment}</izz></inertia></inertial>
  <collision name="c"><geometry><sphere><radius>{size}</radius></sphere></geometry></collision>
</link>
<joint name="{name}_joint" type="revolute"><parent>{parent}</parent><child>{name}</child>
  <axis><xyz>0 0 1</xyz></axis></joint>
"""


def test_moments_of_one_formula_are_one_finding(tmp_path: Path) -> None:
    links = [("b", "base", 1, 0.05), ("c", "b", 0.5, 0.04), ("d", "c", 0.01, 0.03)]
    parts = [
        LINK.format(name=name, parent=parent, mass=mass, moment=mass * 0.01, size=size)
        for name, parent, mass, size in links
    ]
    base = '<link name="base"><inertial><mass>3</mass></inertial></link>'
    path = tmp_path / "arm.sdf"
    path.write_text(f'<sdf version="1.9"><model name="arm">{base}{"".join(parts)}</model></sdf>')
    settings = Settings(trial=False, select=("INE004",), profile="gazebo-harmonic")
    (report,) = check_package(path, settings).packages
    (found,) = report.findings
    assert found.severity is Severity.WARNING
    said = [place.message or found.message for place in found.places]
    assert [text.split()[1] for text in said] == ["'d'", "'c'", "'b'"]


@pytest.mark.parametrize(
    ("part", "mass", "severity"),
    [
        ("", 1, Severity.INFO),
        ('<sensor name="s" type="imu"/>', 1, Severity.WARNING),
        # Its shape gives 1.5 kg·m².
        ('<sensor name="s" type="imu"/>', 9, Severity.INFO),
    ],
)
def test_a_unit_tensor_of_a_prop_or_about_right_is_an_info(
    tmp_path: Path, part: str, mass: float, severity: Severity
) -> None:
    ones = "<ixx>1</ixx><iyy>1</iyy><izz>1</izz>"
    (tmp_path / "crate.sdf").write_text(f"""<sdf version="1.9"><model name="crate">
<link name="crate"><inertial><mass>{mass}</mass><inertia>{ones}</inertia></inertial>{part}
  <collision name="c"><geometry><box><size>1 1 1</size></box></geometry></collision>
</link></model></sdf>""")
    settings = Settings(trial=False, select=("INE007",), profile="gazebo-harmonic")
    (report,) = check_package(tmp_path / "crate.sdf", settings).packages
    assert [finding.severity for finding in report.findings] == [severity]
