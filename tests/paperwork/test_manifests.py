"""package.xml and model.config."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.package.manifests import read_model_config, read_package_xml
from checker.source.text import SourceText
from checker.source.text_file import decode
from checker.source.xml import XmlDocument, parse_xml


def parse(text: str, file: str = "package.xml") -> XmlDocument:
    document = parse_xml(SourceText(file, text))
    assert isinstance(document, XmlDocument)
    return document


def test_a_manifest_and_the_texts_it_is_marked_at():
    manifest = read_package_xml(
        parse(
            """<package format="2">
  <name>rover_sensor_config_1</name>
  <version>0.1.0</version>
  <description>A <b>rover</b>
    with wheels</description>
  <maintainer email="a@b.org">Ann</maintainer>
  <author>Bob</author>
  <license>BSD</license>
  <url type="website">http://wiki.ros.org/rover</url>
  <buildtool_depend>catkin</buildtool_depend>
  <exec_depend> xacro </exec_depend>
  <!-- <exec_depend>urdf</exec_depend> -->
  <export><build_type>cmake</build_type></export>
</package>"""
        )
    )
    assert (manifest.format.value, manifest.format.span.text) == (2, "2")
    assert manifest.name.span.text == "rover_sensor_config_1"
    assert manifest.version.value == "0.1.0"
    assert manifest.description.value == "A rover with wheels"
    assert manifest.description.span.text == "A <b>rover</b>\n    with wheels"
    assert [(each.name.value, each.email.value) for each in manifest.maintainers] == [
        ("Ann", "a@b.org")
    ]
    assert not manifest.authors[0].email.stated
    assert [each.value for each in manifest.licenses] == ["BSD"]
    assert [
        (each.kind, each.package.value, each.at_run_time) for each in manifest.dependencies
    ] == [
        ("buildtool_depend", "catkin", False),
        ("exec_depend", "xacro", True),
    ]
    assert manifest.dependencies[1].package.span.text == "xacro"
    assert manifest.depends_on("xacro")
    assert not manifest.depends_on("urdf")
    assert manifest.build_type.value == "cmake"
    assert [each.value for each in manifest.urls] == ["http://wiki.ros.org/rover"]


def test_what_a_manifest_lacks_is_empty_not_stated_and_placed_at_the_root():
    manifest = read_package_xml(parse("<package><description> </description></package>"))
    assert (manifest.format.value, manifest.format.stated) == (1, False)
    for value in (manifest.name, manifest.version, manifest.build_type):
        assert (value.value, value.stated, value.span.text) == ("", False, "<package>")
    assert (manifest.description.stated, manifest.description.span.text) == (False, "<description>")
    assert (manifest.maintainers, manifest.licenses, manifest.dependencies) == ((), (), ())


@pytest.mark.parametrize("format_", ["x", "", "4", "²"])
def test_a_format_that_is_none_has_no_number(format_):
    assert read_package_xml(parse(f'<package format="{format_}"/>')).format.value is None


def test_a_model_config_and_the_texts_it_is_marked_at():
    config = read_model_config(
        parse(
            """<model><name>Rover 1</name><version>1.0</version>
<sdf version="1.6">model.sdf</sdf><sdf>model-1_4.sdf</sdf>
<author><name>Ann</name><email>a@b.org</email></author><author/>
<description>Two lidars</description>
<depend><model><uri>model://arm</uri></model><uri>model://leg</uri></depend></model>""",
            "model.config",
        )
    )
    assert (config.name.value, config.version.value) == ("Rover 1", "1.0")
    assert [(each.file.value, each.version.value, each.version.stated) for each in config.sdf] == [
        ("model.sdf", "1.6", True),
        ("model-1_4.sdf", "", False),
    ]
    assert config.sdf[0].file.span.text == "model.sdf"
    assert config.authors[0].email.span.text == "a@b.org"
    assert (config.authors[1].name.stated, config.authors[1].name.span.text) == (False, "<author/>")
    assert config.description.value == "Two lidars"
    assert [each.value for each in config.depends] == ["model://arm"]


def test_an_empty_model_config_states_nothing():
    config = read_model_config(parse("<model/>", "model.config"))
    assert (config.sdf, config.authors) == ((), ())
    assert not any(each.stated for each in (config.name, config.version, config.description))


def test_every_real_package_states_its_name_and_its_model(corpus: Path):
    manifests = sorted(corpus.glob("*/package.xml"))
    assert len(manifests) == 18
    for path in manifests:
        manifest = read_package_xml(parse(decode(path.read_bytes())))
        assert manifest.name.value == path.parent.name
        assert manifest.depends_on("catkin")
        assert manifest.maintainers
        assert all(person.email.stated for person in manifest.maintainers)
    configs = sorted(corpus.glob("*/model.config"))
    assert len(configs) == 14
    for path in configs:
        (entry,) = read_model_config(parse(decode(path.read_bytes()))).sdf
        assert (path.parent / entry.file.value).is_file()
