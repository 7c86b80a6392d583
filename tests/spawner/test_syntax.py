"""Syntax errors are named only when they are certain."""

import random
import subprocess

import pytest

from checker.source.ruby import parse_ruby, syntax_faults
from checker.source.text import SourceText

CERTAIN = {
    "def f\n  <<~XML\n    a\nend\n": (2, "<<~XML"),
    "def f\n  <<-A + <<-B\n  A\nend\n": (2, "<<-B"),
    "def f\n  1\nend\nend\n": (4, "end"),
    "def f\n  'abc\nend\n": (2, "'"),
    "def f\n  [1].each do |x|\n    x\nend\n": (1, "def"),
    "def f\n  if x\n    1\nend\n": (1, "def"),
}


def faults(text):
    return syntax_faults(parse_ruby(SourceText("s.rb", text)))


@pytest.mark.parametrize("text", CERTAIN)
def test_certain_fault(text):
    [(span, message)] = faults(text)
    assert (span.line, span.text) == CERTAIN[text]
    assert message


@pytest.mark.parametrize(
    "text",
    [
        "def f\n  1\nend\n",
        'def f\n  "#{<<~X}y"\n    a\n  X\nend\n',
        "def f\n  <<~X\n    'it\n  X\nend\n",
        "x = 'end'\n",
        "def f\n  a.end\nend\n",
        "def f\n  {end: 1}[:end]\nend\n",
        "class A\n  def end; end\nend\n",
    ],
)
def test_valid_ruby_has_no_fault(text):
    assert faults(text) == ()


@pytest.mark.usefixtures("ruby")
def test_no_fault_in_what_ruby_accepts(corpus, tmp_path):
    """Damaged copies of real spawners: whatever we call a fault, Ruby refuses as well."""
    choose = random.Random(7)  # noqa: S311 damages files, guards nothing
    found = checked = 0
    for path in sorted(corpus.root.glob("*/launch/*.rb"))[::3]:
        lines = path.read_text().splitlines(keepends=True)
        for _ in range(12):
            damaged = list(lines)
            at = choose.choice([i for i, line in enumerate(lines) if line.strip()])
            damaged[at] = choose.choice(
                ["", damaged[at].replace('"', "", 1), "end\n", damaged[at] * 2]
            )
            text = "".join(damaged)
            checked += 1
            if faults(text):
                found += 1
                file = tmp_path / "s.rb"
                file.write_text(text)
                verdict = subprocess.run(["ruby", "-c", file], capture_output=True, check=False)
                assert verdict.returncode != 0, text
    assert checked > 50
    assert found > 3
