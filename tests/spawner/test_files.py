"""Other files: only those of the workspace, by every road that Ruby offers."""

import pytest

from checker.launch.spawner.reader import Unread

COMMON = 'def g(a)\n  "<#{a}>"\nend\n'
ROADS = {
    "require_relative": "require_relative 'common'",
    "require_relative with suffix": "require_relative './common.rb'",
    "load by folder": "load File.join(__dir__, 'common.rb')",
    "load by file": "load File.expand_path('common.rb', File.dirname(__FILE__))",
    "expand_path from the file": "load File.expand_path('../common.rb', __FILE__)",
    "require by path": "require File.join(File.dirname(__FILE__), 'common')",
    "rospack": "load `rospack find robot`.chomp + '/launch/common.rb'",
    "rospack in a string": 'load "#{`rospack find robot`.strip}/launch/common.rb"',
    "exist": "f = File.join(__dir__, 'common.rb')\nload f if File.exist?(f)",
}


@pytest.mark.parametrize("road", ROADS)
def test_road_to_a_shared_file(workspace, road):
    made = workspace(f"{ROADS[road]}\ndef f\n  g('x')\nend\n")
    made.files["robot/launch/common.rb"] = COMMON
    spawner = made.spawner()
    emitted = spawner.evaluate("f", [])
    assert not isinstance(emitted, Unread), emitted.reason
    assert emitted.text == "<x>"
    assert emitted.place(0, 1).file == "robot/launch/common.rb"
    assert [s.file for s in spawner.sources] == [
        "robot/launch/spawner.rb",
        "robot/launch/common.rb",
    ]
    assert spawner.functions["g"].path == "robot/launch/common.rb"


def test_paths_given_to_the_loader_are_clean_and_inside(workspace):
    made = workspace(
        "require_relative '../../robot/./launch/../launch/common'\ndef f\n g('x')\nend"
    )
    made.files["robot/launch/common.rb"] = COMMON
    made.spawner()
    assert set(made.asked) == {"robot/launch/common.rb", "robot/launch/example.ign"}


def test_a_file_is_required_once_and_loaded_twice(workspace):
    made = workspace(
        "$n = ''\nrequire_relative 'a'\nrequire_relative 'a'\n"
        "load __dir__ + '/a.rb'\ndef f\n  $n\nend\n"
    )
    made.files["robot/launch/a.rb"] = "$n << 'a'\n"
    assert made.spawner().evaluate("f", []).text == "aa"


def test_a_missing_file_can_be_rescued(emit):
    text = (
        "def f\n  begin\n    load __dir__ + '/none.rb'\n  rescue LoadError\n    'gone'\n  end\nend"
    )
    assert emit(text).text == "gone"


def test_a_missing_package_is_named_even_inside_a_rescue(emit):
    text = "def f\n  require_relative '../../base/launch/c'\nrescue LoadError\n  ''\nend"
    assert emit(text).reason == "package base is not available"


def test_files_that_load_each_other_end(emit):
    files = {"robot/launch/a.rb": "load __dir__ + '/a.rb'\n"}
    assert isinstance(emit("load __dir__ + '/a.rb'\ndef f\n  ''\nend", files=files), Unread)


YAML_TEXT = """
numbers: [1, 2.5, -3, 1.0e-3, 0x1f]
flags: {a: yes, b: False, c: ~, d: "yes"}
list:
  - name: l
    at: 0.10
"""


def test_values_of_yaml(emit, ruby, tmp_path):
    code = (
        "require 'yaml'\ndef f\n  y = YAML.load_file(File.join(__dir__, 'y.yaml'))\n"
        '  z = YAML.load(File.read(__dir__ + "/y.yaml"))\n'
        '  "#{y["numbers"]} #{y["flags"].values[0..2]} #{y["flags"]["d"]}'
        ' #{y["list"][0].values.join} #{z["list"][0]["name"]}"\nend\n'
    )
    (tmp_path / "s.rb").write_text(code)
    (tmp_path / "y.yaml").write_text(YAML_TEXT)
    [[expected]] = ruby.run([(tmp_path / "s.rb", [("f", [], False)])])
    assert emit(code, files={"robot/launch/y.yaml": YAML_TEXT}).text == expected


def test_functions_with_their_parameters(workspace):
    spawner = workspace("def spawner(_a, _b = 'x', *c, k: 1)\n  ''\nend\n").spawner()
    function = spawner.functions["spawner"]
    assert [(p.name, p.kind) for p in function.parameters] == [
        ("_a", "required"),
        ("_b", "optional"),
        ("c", "rest"),
        ("k", "keyword"),
    ]
    assert function.required == 1
    assert function.span.text == "def spawner(_a, _b = 'x', *c, k: 1)"
    assert function.parameters[1].span.text == "_b = 'x'"


def test_each_call_starts_clean(workspace):
    spawner = workspace("$n = 0\ndef f\n  $n += 1\n  $n.to_s\nend").spawner()
    assert [spawner.evaluate("f", []).text for _ in range(2)] == ["1", "1"]
