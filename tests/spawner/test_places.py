"""Every emitted character knows the Ruby character that wrote it."""

import pytest

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
