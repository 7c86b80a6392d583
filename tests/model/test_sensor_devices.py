"""Which sensor stands for which device: the sheet says it, else the model, else nobody knows."""

from __future__ import annotations

from checker.model.devices.known import known_devices
from checker.model.devices.sensors import find_sensor_devices
from checker.model.specification.sheet import Specification, read_specification
from checker.source.text import SourceText
from tests.model.robots import sdf

KNOWN = known_devices()


def sensor(name: str, type: str = "gpu_lidar", *, samples: int = 1800, rows: int = 16) -> str:
    if type != "gpu_lidar":
        return f'<sensor name="{name}" type="{type}"/>'
    return f"""<sensor name="{name}" type="gpu_lidar"><lidar><scan>
<horizontal><samples>{samples}</samples></horizontal>
<vertical><samples>{rows}</samples></vertical></scan></lidar></sensor>"""


def point(name: str) -> str:
    return sensor(name, samples=1, rows=1)


def plane(name: str) -> str:
    return sensor(name, samples=920, rows=1)


def sheet(*items: str, lead: str = "", below: str = "") -> Specification:
    text = "\n".join(f"* {item}" for item in items)
    return read_specification(
        SourceText("specifications.md", f"# R\n\n## Sensors\n\n{lead}\n\n{text}\n\n{below}")
    )


def found(*sensors: str, by: Specification | None = None, number: int = 1) -> dict[str, str]:
    """Return devices by the sensors' names; `*` in front when the model's own words say so."""
    robot = sdf(f'<link name="body">{"".join(sensors)}</link>')
    devices = find_sensor_devices(robot, KNOWN, by, {number})
    return {
        each.sensor.name.value: f"{'' if each.from_sheet else '*'}{each.device.id}"
        for each in devices.known
    }


def test_the_only_item_of_a_type_means_the_only_sensor() -> None:
    by = sheet("Velodyne VLP-16, modeled by gpu_lidar", "Xsens MTi 100 IMU, modeled by imu plugin")
    assert found(sensor("scan"), sensor("imu", "imu"), by=by) == {
        "scan": "velodyne_vlp16",
        "imu": "xsens_mti",
    }


def test_several_sensors_count() -> None:
    two = (sensor("left"), sensor("right"))
    both = {"left": "velodyne_vlp16", "right": "velodyne_vlp16"}
    assert found(*two, by=sheet("2x Velodyne VLP-16, modeled by gpu_lidar")) == both
    assert found(*two, by=sheet("Velodyne VLP-16 lidars, modeled by gpu_lidar")) == both
    assert found(*two, by=sheet("3x Velodyne VLP-16, modeled by gpu_lidar")) == {}
    assert found(*two, by=sheet("A Velodyne VLP-16, modeled by gpu_lidar")) == {}


def test_without_a_number_sensors_must_be_set_alike() -> None:
    by = sheet("Velodyne VLP-16 lidars, modeled by gpu_lidar")
    assert found(sensor("left"), sensor("right", samples=900), by=by) == {}


def test_one_device_may_have_several_cameras() -> None:
    cameras = [sensor(f"camera_{number}", "camera") for number in range(6)]
    assert set(found(*cameras, by=sheet("1 x Ladybug LB-3 camera")).values()) == {"ladybug3"}


def test_names_choose_among_items() -> None:
    by = sheet("LIDAR - Velodyne VLP-16, modeled by gpu_lidar", "LIDAR - Robosense RS-Bpearl")
    assert found(sensor("front_vlp16"), sensor("rear_bpearl", rows=32), by=by) == {
        "front_vlp16": "velodyne_vlp16",
        "rear_bpearl": "robosense_bpearl",
    }
    # What is named takes its item; the other one is left for the sensor without a name.
    assert found(sensor("laser"), sensor("bpearl"), sensor("bpearl_2"), by=by) == {
        "laser": "velodyne_vlp16",
        "bpearl": "robosense_bpearl",
        "bpearl_2": "robosense_bpearl",
    }


def test_words_for_places_choose_among_items() -> None:
    by = sheet("Front lidar: Velodyne VLP-16", "Rear lidar: Ouster OS0")
    assert found(sensor("laser_front"), sensor("laser_back", rows=64), by=by) == {
        "laser_front": "velodyne_vlp16",
        "laser_back": "ouster_os0",
    }


def test_scans_choose_among_items() -> None:
    by = sheet(
        "Velodyne VLP-16 3D lidar", "RPLidar S1 planar lidar", "2x Lidar Lite, modeled by gpu_ray"
    )
    sensors = (sensor("a"), plane("b"), point("c"), point("d"))
    assert found(*sensors, by=by) == {
        "a": "velodyne_vlp16",
        "b": "rplidar_s1",
        "c": "lidar_lite_v3",
        "d": "lidar_lite_v3",
    }


def test_sensors_that_the_sheet_does_not_list_are_not_taken_for_those_it_lists() -> None:
    by = sheet("A Velodyne VLP-16 lidar, modeled by gpu_lidar")
    sensors = (sensor("front_laser"), point("top_laser"))
    assert found(*sensors, by=by) == {"front_laser": "velodyne_vlp16"}


def test_doubt_is_not_knowing() -> None:
    two = sheet("LIDAR - Velodyne VLP-16", "LIDAR - Ouster OS0")
    assert found(sensor("left_laser"), sensor("right_laser"), by=two) == {}
    assert found(sensor("laser"), by=sheet("3D lidar of our own, modeled by gpu_lidar")) == {}
    assert found(sensor("vlp16"), by=sheet("Ouster OS0 lidar, modeled by gpu_lidar")) == {}


def test_what_is_not_modeled_does_not_count() -> None:
    by = sheet("Velodyne VLP-16 lidar, modeled by gpu_lidar", "Ouster OS0 lidar, not modeled")
    assert found(sensor("scan"), by=by) == {"scan": "velodyne_vlp16"}


def test_items_of_other_configurations_do_not_count() -> None:
    by = sheet("Velodyne VLP-16 lidar", "Sensor configuration 3 has an Ouster OS0 lidar instead")
    assert found(sensor("scan"), by=by) == {"scan": "velodyne_vlp16"}
    only_one = sheet("Velodyne VLP-16 lidar", lead="Sensor Config 1 uses:")
    assert found(sensor("scan"), by=only_one) == {"scan": "velodyne_vlp16"}
    assert found(sensor("scan"), by=only_one, number=2) == {}


def test_a_link_of_an_item_names_the_device() -> None:
    by = sheet("1x [3D lidar](https://velodynelidar.com/vlp-16.html), modeled by gpu_lidar")
    assert found(sensor("scan"), by=by) == {"scan": "velodyne_vlp16"}


LINKS = "## Links\n\n* [lidar](https://velodynelidar.com/vlp-16.html)\n"


def test_the_only_device_of_a_class_in_the_rest_of_the_sheet_counts() -> None:
    plain = "3D lidar, modeled by gpu_lidar"
    by = sheet(plain, "RPLidar S1, modeled by gpu_lidar", below=LINKS)
    assert found(sensor("scan"), plane("low"), by=by) == {
        "scan": "velodyne_vlp16",
        "low": "rplidar_s1",
    }
    costs = "## Cost\n\n$8,000 - Velodyne VLP-16\n\n$75 - Lidar Lite v3\n"
    assert found(sensor("scan"), by=sheet(plain, below=costs)) == {"scan": "velodyne_vlp16"}
    two = f"{LINKS}\nOuster OS0 lidars are planned.\n"
    assert found(sensor("scan"), by=sheet(plain, below=two)) == {}


def test_remarks_below_an_item_count() -> None:
    remark = "\n  * Velodyne VLP-16 with 16 rows"
    assert found(sensor("scan"), by=sheet(f"3D lidar{remark}")) == {"scan": "velodyne_vlp16"}
    assert found(sensor("scan"), by=sheet(f"3D lidar, not modeled{remark}")) == {}
    other = sheet(f"Sensor config 2 adds a 3D lidar{remark}")
    assert found(sensor("scan"), by=other) == {}
    assert found(sensor("scan"), by=other, number=2) == {"scan": "velodyne_vlp16"}


def test_the_rest_of_the_sheet_names_the_model_of_a_family() -> None:
    listed = "FLIR Blackfly S, modeled by camera plugin"
    link = "## Links\n\n[camera](https://www.flir.com/?model=BFS-U3-88S6C-C)\n"
    assert found(sensor("eye", "camera"), by=sheet(listed)) == {"eye": "flir_blackfly_s"}
    by = sheet(listed, below=link)
    assert found(sensor("eye", "camera"), by=by) == {"eye": "flir_by_code bfs-u3-88s6c"}
    other = sheet(listed, below=link + "\n[the other](https://www.flir.com/?model=BFS-U3-23S3C)\n")
    assert found(sensor("eye", "camera"), by=other) == {"eye": "flir_blackfly_s"}


def test_the_rest_of_the_sheet_does_not_overrule_the_list() -> None:
    for item in ("Livox Mid-70 lidar, modeled by gpu_lidar", "Ouster OS0 lidar"):
        assert "velodyne_vlp16" not in found(sensor("scan"), by=sheet(item, below=LINKS)).values()
    assert found(sensor("os0"), by=sheet("3D lidar", below=LINKS)) == {}
    three = sheet("3x Velodyne VLP-16, modeled by gpu_lidar", below=LINKS)
    assert found(sensor("left"), sensor("right"), by=three) == {}


def test_the_rest_of_the_sheet_is_not_about_other_sensors() -> None:
    by = sheet("3D lidars, modeled by gpu_lidar", below=LINKS)
    assert found(sensor("left"), sensor("right", rows=32), by=by) == {}
    other = LINKS.replace("## Links", "## Sensor Configuration 2")
    assert found(sensor("scan"), by=sheet("3D lidar", below=other)) == {}
    assert found(sensor("scan"), by=sheet("3D lidar", below=other), number=2) != {}
    unused = LINKS.replace("[lidar]", "not modeled: [lidar]")
    assert found(sensor("scan"), by=sheet("3D lidar", below=unused)) == {}


def test_without_a_sheet_names_and_comments_tell() -> None:
    assert found(sensor("os1_lidar")) == {"os1_lidar": "*ouster_os1_64"}
    assert found("<!-- Based on RPLidar S1 -->", sensor("scan")) == {"scan": "*rplidar_s1"}
    assert found("<!-- RPLidar S1 -->", sensor("imu", "imu"), sensor("scan")) == {}


def test_paragraphs_of_diversions() -> None:
    below = (
        "## Diversions from Physical Hardware\n\nThe lidar's range is 50 m.\n\nThe wheels slip.\n"
    )
    by = sheet("Velodyne VLP-16 lidar", below=below)
    devices = find_sensor_devices(sdf(f'<link name="b">{sensor("s")}</link>'), KNOWN, by, {1})
    (each,) = devices.known
    assert devices.are_diverted(each.device, r"\brange\b")
    assert not devices.are_diverted(each.device, r"\bslip\b")
    assert not devices.are_diverted(each.device, r"\brows\b")
