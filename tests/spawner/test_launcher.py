"""Globals that a launcher sets before it loads the spawner, and `defined?`."""

import pytest

EXAMPLE = """<%
  require_relative 'spawner'
  $enableGroundTruth = true
  $crumbs = 6   # of them
  $kind = "fast"
  $folder = File.dirname(__FILE__)
%>
<ignition/>
"""


@pytest.mark.parametrize(
    ("text", "emitted"),
    [
        ("$worldName", "world_name"),
        ("$worldName.include?('cave')", "false"),
        ("$crumbs + 1", "7"),
        ("$kind", "fast"),
        ("$enableGroundTruth", "false"),
        ("$folder", ""),
        ("defined?($crumbs) ? 1 : 2", "1"),
        ("defined?($other) ? 1 : 2", "2"),
        ("defined? g", "method"),
        ("defined?(nothing).nil?", "true"),
    ],
)
def test_globals_have_the_values_that_a_launcher_gives(emit, text, emitted):
    program = f'def g\n  1\nend\ndef f\n  "#{{{text}}}"\nend\n'
    result = emit(program, files={"robot/launch/example.ign": EXAMPLE})
    assert result.text == emitted
