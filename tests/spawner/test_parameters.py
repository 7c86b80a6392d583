"""A stretch of the emitted text depends on the parameters and globals that change it."""

import pytest

from checker.launch.spawner.emitted_xml import SpawnedXml
from checker.launch.spawner.reader import read_spawner
from checker.source.text import SourceText
from checker.source.xml_fragments import parse_fragments
from tests.spawner.conftest import Workspace

PATH = "robot/launch/spawner.rb"
PARAMETERS = "name, uri, world, x, y, z, roll, pitch, yaw"


@pytest.fixture
def depends():
    """Return what the text of an element depends on, by the body of `spawner`."""

    def on(body, tag="a", before=""):
        text = f"{before}\ndef spawner({PARAMETERS})\n  {body}\nend\n"
        spawner = read_spawner(Workspace({PATH: text}), PATH, SourceText(PATH, text))
        spawned = SpawnedXml(spawner.spawn, parse_fragments(spawner.spawn), spawner)
        return set(spawned.parameters_of(spawned.document.root.child(tag).text_span))

    return on


@pytest.mark.parametrize(
    ("written", "parameters"),
    [
        ("#{x * 2 + 1}", {"x"}),
        ("#{name.upcase}", {"name"}),
        ("#{x}|#{y}", {"x", "y"}),
        ("#{uri.sub('model://', '')}", {"uri"}),
        ("#{[z, 5].max} #{[z, 1].min}", {"z"}),
        ("#{yaw.abs} #{roll.round} #{pitch > 0}", {"yaw", "roll", "pitch"}),
        ("#{world}#{$worldName}", {"world", "$worldName"}),
        ("#{$enableGroundTruth}", {"$enableGroundTruth"}),
        ("#{z - z}", set()),
        ("constant", set()),
    ],
)
def test_a_text_depends_on_what_changes_it(depends, written, parameters):
    assert depends(f'"<b>#{{name}}</b><a>{written}</a><c>#{{x}}</c>"') == parameters


@pytest.mark.parametrize(
    "choice",
    [
        "n = 'no'\n  if $enableGroundTruth\n    n = 'yes'\n  end",
        "n = $enableGroundTruth ? 'yes' : 'no'",
        "if $enableGroundTruth then n = true else n = false end",
        "n = 'no'\n  n = 'yes' if $enableGroundTruth",
        "n = case $enableGroundTruth when true then 1 else 0 end",
        "n = case when $enableGroundTruth then 1 else 0 end",
        "n = 1\n  n = 2 unless !$enableGroundTruth",
        "n = {true => 'a', false => 'b'}[$enableGroundTruth]",
        "return '<a>late</a>' if $enableGroundTruth\n  n = 1",
    ],
)
def test_a_text_depends_on_what_chooses_it(depends, choice):
    assert depends(f'{choice}\n  "<a>#{{n}}</a>"') == {"$enableGroundTruth"}


def test_text_added_by_choice_leaves_the_text_around_it_alone(depends):
    body = "s = '<a>1</a>'\n  s += '<b>2</b>' if $enableGroundTruth\n  s + '<c>3</c>'"
    assert depends(body, "a") == depends(body, "c") == set()


def test_text_left_out_by_another_value_depends_on_it(depends):
    body = "s = '<a>1</a>'\n  s += '<b>2</b>' unless $enableGroundTruth\n  s + '<c>3</c>'"
    assert depends(body, "b") == {"$enableGroundTruth"}
    assert depends(body, "a") == depends(body, "c") == set()


def test_rounds_of_a_loop_are_told_apart(depends):
    body = '[1, x].map { |n| "<a>#{n}</a>" }.reverse.join'
    assert depends(body) == {"x"}
    assert depends(body.replace(".reverse", "")) == set()


def test_parameters_pass_through_functions_and_arrays(depends):
    before = "def g(v)\n  [v, 1]\nend"
    body = 'r = g(x)\n  "<a>#{r[0]}</a><b>#{r[1]}</b>"'
    assert depends(body, "a", before) == {"x"}
    assert depends(body, "b", before) == set()


def test_a_text_that_another_value_ends_depends_on_it(depends):
    body = "raise 'unknown' if name != 'robot_name'\n  '<a>1</a>'"
    assert depends(body) == {"name"}


def test_an_empty_stretch_depends_on_nothing(depends):
    assert depends('"<a></a>"') == set()


def test_variants_share_their_steps(depends):
    """Without a result for some of the arguments, the text may depend on them."""
    names = depends("9000.times { |n| n + 1 }\n  '<a>1</a>'")
    assert "name" not in names
    assert {"yaw", "$worldName"} <= names
