"""Every emitted character knows the Ruby character that wrote it."""

import pytest

from checker.launch.spawner.reader import Unread
from checker.source.text import Span
from checker.source.xml import XmlDocument, parse_xml

ESCAPES = {"\n": "\\n", '"': '\\"', "\t": "\\t"}


def assert_literals_map_back(emitted):
    for offset, char in enumerate(emitted.text):
        piece = emitted.pieces[emitted._index(offset)]
        origin = emitted.origin_of(offset, offset + 1)
        if piece.exact:
            assert origin.text == char
        elif piece.literal:
            assert origin.text in {ESCAPES.get(char), "\r\n"}
        else:
            assert origin.text.startswith("#{") or origin.source is not emitted.origin.source


def test_every_literal_character_of_the_real_packages(corpus):
    for path in sorted(corpus.root.glob("*/launch/spawner.rb")):
        spawner = corpus.spawner(path.parent.parent.name)
        for emitted in (spawner.spawn, spawner.executables):
            assert_literals_map_back(emitted)
            assert sum(len(p.text) for p in emitted.pieces if p.literal) > 0.7 * len(emitted.text)


def test_places_of_the_real_packages_hold_the_tag(corpus):
    """The Ruby line of an element shows its start tag, unless its name is computed."""
    for path in sorted(corpus.root.glob("*/launch/spawner.rb")):
        emitted = corpus.spawner(path.parent.parent.name).spawn
        document = parse_xml(emitted)
        assert isinstance(document, XmlDocument)
        for element in document.elements:
            if not element.tag.startswith(("LF_", "RF_", "LH_", "RH_", "left_t", "right_t")):
                assert f"<{element.tag}" in element.span.place().snippet


def test_a_pose_points_at_its_line_and_columns(emit):
    emitted = emit(
        "def f(z)\n  <<~X\n    <a>\n      <pose>0 0 #{z + 1}</pose>\n    </a>\n  X\nend\n", 2
    )
    pose = parse_xml(emitted).root.child("pose")
    place = pose.text_span.place()
    assert (place.file, place.line, place.column) == ("robot/launch/spawner.rb", 4, 13)
    assert place.end_column == 13 + len("0 0 #{z + 1}")
    assert place.snippet == "      <pose>0 0 #{z + 1}</pose>"


def test_a_computed_piece_is_its_interpolation(emit):
    emitted = emit('def f(z)\n  "a#{z}b"\nend', 7)
    assert [p.span.text for p in emitted.pieces] == ["a", "#{z}", "b"]
    assert [p.literal for p in emitted.pieces] == [True, False, True]


def test_text_built_elsewhere_keeps_its_own_place(emit):
    emitted = emit('def f\n  row = "<r/>"\n  "<a>#{row}</a>"\nend')
    assert parse_xml(emitted).root.child("r").span.place().line == 2


def test_a_stretch_over_pieces_out_of_order_points_at_the_first(emit):
    emitted = emit('def f\n  x = "late"\n  "early#{x}"\nend')
    assert emitted.place(0, 9).line == 3
    assert emitted.place(5, 9).line == 2


def test_text_of_a_yaml_file_points_into_it(emit):
    path = "File.join(__dir__, '..', 'c.yaml')"
    text = f"require 'yaml'\ndef f\n  YAML.load_file({path})['é']['name']\nend"
    emitted = emit(text, files={"robot/c.yaml": "# ü\né:\n  name: wheel_é\n"})
    place = emitted.place(0, 5)
    assert (emitted.text, place.file, place.line, place.column) == ("wheel_é", "robot/c.yaml", 3, 9)


def test_non_ascii_text_before_it_does_not_shift_a_place(emit):
    emitted = emit("def f\n  # äöü€\n  'ü' + 'x'\nend")
    assert emitted.origin_of(1, 2).text == "x"
    assert emitted.place(1, 2).column == 10


def test_parts_cut_off_keep_their_place(emit):
    emitted = emit('def f\n  "  a,bc \\n".strip.split(",").join("-").sub("c", "d")\nend')
    assert emitted.text == "a-bd"
    assert [emitted.origin_of(i, i + 1).text for i in range(4)] == ["a", "-", "b", "d"]


@pytest.mark.parametrize("text", ["def f\n  ''\nend", "def f\n  <<~X\n  X\nend"])
def test_an_empty_text_points_at_the_function(emit, text):
    emitted = emit(text)
    assert emitted.text == ""
    assert emitted.place(0, 0).line == 1
    assert Span(emitted, 0, 0).line == 1


def influences(emitted, part):
    assert not isinstance(emitted, Unread), emitted.reason
    at = emitted.text.index(part)
    return set(emitted.parameters_in(at, at + len(part)))


def test_parameters_that_influenced_a_text(emit):
    text = 'def f(name, x, y)\n  z = x * 2 + 1\n  s = name.upcase\n  "<#{z}|#{y}|#{s}>"\nend'
    emitted = emit(text, "bob", 1, 5)
    assert influences(emitted, "3") == {"x"}
    assert influences(emitted, "5") == {"y"}
    assert influences(emitted, "BOB") == {"name"}
    assert influences(emitted, "3|5") == {"x", "y"}
    assert influences(emitted, "<") == set()


@pytest.mark.parametrize("truth", [True, False])
@pytest.mark.parametrize(
    "choice",
    [
        "n = 'no'\n  if $enableGroundTruth\n    n = 'yes'\n  end",
        "n = $enableGroundTruth ? 'yes' : 'no'",
        "if $enableGroundTruth then n = true else n = false end",
        "n = 'no'\n  n = 'yes' if $enableGroundTruth",
        "n = case $enableGroundTruth when true then 1 else 0 end",
        "n = 1\n  n = 2 unless !$enableGroundTruth",
        "n = $enableGroundTruth && 1",
        "n = {true => 'a', false => 'b'}[$enableGroundTruth]",
    ],
)
def test_a_choice_by_ground_truth_is_an_influence(emit, choice, truth):
    emitted = emit(f'def f\n  {choice}\n  "<a>#{{n}}</a>"\nend', ground_truth=truth)
    value = emitted.text.removeprefix("<a>").removesuffix("</a>")
    assert influences(emitted, f">{value}<") == {"$enableGroundTruth"}
    assert influences(emitted, "<a") == set()


def test_text_added_by_choice_does_not_influence_the_text_around_it(emit):
    branch = 'if $enableGroundTruth\n    s += "b"\n    s << "c"\n  end'
    text = f'def f\n  s = "a"\n  {branch}\n  s + "d"\nend'
    emitted = emit(text, ground_truth=True)
    assert influences(emitted, "b") == influences(emitted, "c") == {"$enableGroundTruth"}
    assert influences(emitted, "a") == influences(emitted, "d") == set()


def test_influences_pass_through_functions_and_arrays(emit):
    text = 'def g(v)\n  [v, 1]\nend\ndef f(x)\n  a = g(x)\n  "#{a[0]}|#{a[1]}"\nend'
    emitted = emit(text, 8)
    assert influences(emitted, "8") == {"x"}
    assert influences(emitted, "1") == set()
