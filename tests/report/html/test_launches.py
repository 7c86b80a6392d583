"""The graph of each launch on the page: its boxes, its lines, and what is red."""

from __future__ import annotations

from pathlib import Path

import pytest
from lxml import html

from checker.engine.launched import launched_files_of
from checker.engine.subject import Subject
from checker.finding import Concern, Place, Severity
from checker.package.inputs import open_input
from checker.report.html.launches import shown_launches
from checker.report.html.page import to_html
from checker.report.launched import Launched, LaunchedNode, LaunchedTopic, LaunchedTransform
from checker.report.render_settings import Palette, RenderSettings
from checker.report.report import PackageReport, Report, ReportedFinding
from checker.ros.wiring.wiring import Wiring
from checker.rule_testing import write_example

ODOMETRY = ("nav_msgs/msg/Odometry",)
LAUNCHED = Launched(
    "launch/rover.launch.py",
    ("config/ekf.yaml", "launch/rover.launch.py"),
    (
        LaunchedNode("plugin DiffDrive by a bridge", ("/odom",), ("/cmd_vel",)),
        LaunchedNode("node '/ekf'", ("/odometry/filtered",), ("/odom", "/wheel/odom")),
    ),
    tuple(
        LaunchedTopic(name, ODOMETRY)
        for name in ("/odom", "/wheel/odom", "/cmd_vel", "/odometry/filtered")
    ),
    (
        LaunchedTransform("odom", "base_link", "node '/ekf'"),
        LaunchedTransform("base_link", "lidar", "joint 'lidar_joint'"),
        LaunchedTransform("mast", "lidar", "node '/mast'"),
    ),
    "a command may start further nodes",
)


def finding(message: str, file: str = "config/ekf.yaml", rule: str = "WIR006") -> ReportedFinding:
    """Return a finding at the first line of a file."""
    place, digits = Place(file, 1, 1, 1, 2), "0123456789abcdef"
    return ReportedFinding(
        rule, "a-rule", Severity.WARNING, Concern.INTERFACE, message, digits, (place,)
    )


def page(*launched: Launched, found: tuple[ReportedFinding, ...] = ()) -> html.HtmlElement:
    """Return the page of a package with these launch files."""
    package = PackageReport("rover", "rover", "urdf", found, launched=launched)
    return html.fromstring(
        to_html(package, Report((package,), {}), RenderSettings(Palette(enabled=False)))
    )


def red(found: ReportedFinding) -> set[str]:
    """Return the names of red boxes."""
    (shown,) = shown_launches([LAUNCHED], [found])
    drawings = [drawing for drawing in (shown.topics, shown.frames) if drawing is not None]
    return {box.label for drawing in drawings for box in drawing.boxes if box.faulty}


def test_nodes_stand_beside_their_topics() -> None:
    topics, frames = page(LAUNCHED).xpath("//section[@id='launches']//svg")

    assert topics.xpath(".//text/text()") == ["plugin DiffDrive by a bridge", "/odom", "/ekf"]
    left, middle, right = (float(it) for it in topics.xpath(".//rect/@x"))
    assert left < middle < right
    assert len(topics.xpath("./path")) == 2
    assert [it.split("  ")[0] for it in frames.xpath(".//g/title/text()")] == [
        *("odom", "base_link", "lidar", "mast", "lidar"),
    ]


def test_topics_of_one_side_and_what_is_not_known_are_told() -> None:
    (section,) = page(LAUNCHED).xpath("//section[@id='launches']")

    text = " ".join(section.text_content().split())
    assert "3 topics: /wheel/odom, /cmd_vel, /odometry/filtered." in text
    assert "There may be more: a command may start further nodes." in text


@pytest.mark.parametrize(
    ("found", "names"),
    [
        (
            finding("node '/ekf' reads /wheel/odom: it is on /odom"),
            {"/ekf", "/wheel/odom", "/odom"},
        ),
        (finding("transform odom → base_link has two publishers"), {"base_link  (/ekf)"}),
        (
            finding("frame 'lidar' has two parents"),
            {"lidar  (joint 'lidar_joint')", "lidar  (/mast)"},
        ),
        (finding("node '/ekf' is elsewhere", file="launch/other.launch.py"), set()),
        (finding("node '/ekf' is of another rule", rule="LCH001"), set()),
    ],
)
def test_what_a_finding_names_is_red(found: ReportedFinding, names: set[str]) -> None:
    assert red(found) == names


def test_without_launch_files_there_is_no_section() -> None:
    assert not page().xpath("//*[@id='launches'] | //a[@href='#launches']")


def test_a_loop_of_frames_ends() -> None:
    loop = (LaunchedTransform("a", "b", "x"), LaunchedTransform("b", "a", "y"))
    (shown,) = shown_launches([Launched("f", (), (), (), loop)], [])

    assert shown.frames is not None
    assert len(shown.frames.boxes) == 3


def test_the_graph_is_that_of_the_launch_file(tmp_path: Path) -> None:
    with open_input(write_example({"@bridge": True}, tmp_path)) as opened:
        subject = Subject(opened.packages[0])
        subject.all(Wiring)
        (launched,) = launched_files_of(subject)
        subject.close()

    assert launched.file == "launch/rover.launch.py"
    assert LaunchedTopic("/scan", ("sensor_msgs/msg/LaserScan",)) in launched.topics
    (lidar,) = (node for node in launched.nodes if "/scan" in node.publishes)
    assert lidar.name == "gpu_lidar sensor 'lidar' by a bridge"
    assert [(it.parent, it.child) for it in launched.transforms] == [("base_link", "lidar_link")]
    assert launched.unknown == ""
