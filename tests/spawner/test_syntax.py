"""Syntax errors are named only when they are certain."""

import json
import random
import re
import subprocess

import pytest

from checker.source.ruby import parse_ruby
from checker.source.ruby_syntax import not_understood, syntax_faults
from checker.source.text import SourceText

CERTAIN = {
    "def f\n  <<~XML\n    a\nend\n": (2, "<<~XML"),
    "def f\n  <<-A + <<-B\n  A\nend\n": (2, "<<-B"),
    "def f\n  <<-A\n  A \nend\n": (2, "<<-A"),
    "def f\n  <<A\n  A\nend\n": (2, "<<A"),
    "def f\n  1\nend\nend\n": (4, "end"),
    "def f\n  'abc\nend\n": (2, "'"),
    "def f\n  [1].each do |x|\n    x\nend\n": (2, "do"),
    "def f\n  if x\n    1\nend\n": (2, "if"),
    "def f\n  if x\n    1\nend\n\ndef g\n  1\nend # of g\n\n": (2, "if"),
    "def f\n  for x in y\n    if x\n      1\n  end\nend\n": (3, "if"),
    "def f\n  case x\n  when 1 then 2\n  unless y\n    1\n  end\nend\n": (2, "case"),
    "def f\n  1\n\ndef g\n  <<-A\n  A\nend\n": (1, "def"),
    "def f\n  for a in b\n    [1].each do |x|\n": (1, "def"),
    "def f\n  x = [\n    [1, 2],\n    [3": (1, "def"),
    "def f\n  x = 'abc\n  g('d')\nend\n\ndef g(a)\n  \"#{a['e']}\"\nend\n": (2, "'"),
    "require yaml'\n\ndef f\n  'abc'\nend\n": (1, "'"),
    "def f\n  x = [a', 'b']\n  g(x, 'c')\nend\n": (2, "'"),
    "def f(a = ', b = 1)\n  'abc'\nend\n": (1, "'"),
    'def f\n  "a\\n"\\\n  b\\n"\\\n  "c"\nend\n': (3, '"'),
    "def f(a, b\n  g(a)\nend\n": (1, "("),
    "def f\n  x = [1, 2\n  g(x)\nend\n": (2, "["),
    "def f\n  g(1))\nend\n": (2, ")"),
    "def f\n  g 1, 2)\nend\n": (2, ")"),
    "def f a, b)\n  1\nend\n": (1, ")"),
    "def f\n  '<a>'\n\n  <spawn name='a'>\n  SDF\nend\n": (5, "SDF"),
    'def f\n  "a"\\ \n  "b"\nend\n': (2, "\\"),
    "def f(a b, c)\n  1\nend\n": (1, "a"),
    "def f\n  g(a, b c)\nend\n": (2, "b"),
    "def f\n  g(a\n    b, c)\nend\n": (2, "a"),
    "x = [1, 2 3]\n": (1, "2"),
    "x = [\n  ['a']\n  ['b'],\n]\n": (2, "]"),
    "x = [\n  'a'\n  'b',\n]\n": (2, "'"),
    "def f\n  1\nelse\n  2\nend\n": (3, "else"),
    "x = 00.5\n": (1, "00.5"),
    "def f\n  RADIUS = 0.1\nend\n": (2, "RADIUS"),
    "def f\n  [1].each { |x| A ||= x }\nend\n": (2, "A"),
    "$x 1\n": (1, "$x"),
}
UNCERTAIN = {
    "x = ->(a) { a } -> 1\n": 1,
    "def f\n  x = ''\n  x <<-A\n    a\n  A\nend\n": 3,
    "def f\n  <<-A\n  A \nend\n\ndef g\n  <<-A\n  A\nend\n": 3,
}
"""What the grammar does not understand or understands wrongly, with its line."""


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
        'def f\n  "a"\\\n  "b"\nend\n',
        "def f\n  <<-A\n  a \\ b\n  A\nend\n",
        "# a \\ b\n=begin\n a \\ b\n=end\nx = 1\n",
        "def f\n  g(a b)\nend\n",
        "x = [a, -1, b(c), 'd' 'e']\n",
        "x = a [1]\ny = a\n[1].each { |z| z }\n",
        "def f\n  1\nrescue\n  2\nelse\n  3\nend\n",
        "def f\n  begin\n    1\n  rescue A\n    2\n  else\n    3\n  end\nend\n",
        "def f(n)\n  n <<X\nend\nX = 1\n",
        "RADIUS = 0.1\ndef f\n  a = RADIUS\n  f(B: 1)\nend\nclass A\n  B = 1\nend\n",
        "x = 0.5 + 10.0\ny = a / b / c\nz = /a/mix\n",
        "def f(if:, in: 1)\n  {else: 1, end: 2}\nend\n",
    ],
)
def test_valid_ruby_has_no_fault(text):
    assert faults(text) == ()


@pytest.mark.parametrize("text", UNCERTAIN)
def test_what_the_grammar_does_not_understand(text):
    tree = parse_ruby(SourceText("s.rb", text))
    assert syntax_faults(tree) == ()
    assert not_understood(tree).line == UNCERTAIN[text]


@pytest.mark.usefixtures("ruby")
def test_ruby_refuses_each_certain_fault():
    assert not any(accepted(list(CERTAIN)))


# Real spawners, each with one piece too few.

PIECES = {
    "end": r"^\s*end\b",
    "def": r"\bdef\b",
    "heredoc": r"<<[-~]\w+",
    "end of a heredoc": r"^\s*[A-Z]+$",
    "quote": "[\"']",
    "parenthesis": "[()]",
    "brace": r"#?[{}]",
    "bracket": r"[\[\]]",
    "comma": ",",
    "plus": r"\+=?",
    "line": r"^.*\n",
    "rest": r"^(?=.)",
}
NEARLY_ALWAYS = PIECES.keys() - {"comma", "plus", "line", "end of a heredoc"}
_EMITTED = re.compile(r"\s*<[!/\w]")


def damaged(text, piece):
    """Yield copies of a text without one piece, in lines of Ruby, not of XML; or cut off."""
    for match in re.finditer(PIECES[piece], text, re.MULTILINE):
        if piece == "rest":
            yield text[: match.start()]
        elif not _EMITTED.match(text, text.rfind("\n", 0, match.start()) + 1):
            yield text[: match.start()] + text[match.end() :]


_COMPILE = """
require 'json'
verdicts = JSON.parse(STDIN.read).map do |text|
  RubyVM::InstructionSequence.compile(text)
  true
rescue SyntaxError
  false
end
print JSON.generate(verdicts)
"""


def accepted(texts):
    """Return of each text whether Ruby compiles it."""
    done = subprocess.run(
        ["ruby", "-W0", "-e", _COMPILE],
        input=json.dumps(texts),
        capture_output=True,
        text=True,
        timeout=120,
        check=True,
    )
    return json.loads(done.stdout)


@pytest.mark.usefixtures("ruby")
@pytest.mark.parametrize("piece", PIECES)
def test_what_ruby_refuses_is_reported(corpus, piece):
    """Each damaged spawner that Ruby refuses is reported, none that it accepts as an error."""
    choose = random.Random(21)  # noqa: S311 damages files, guards nothing
    texts = []
    for path in sorted(corpus.root.glob("*/launch/*.rb")):
        found = [*damaged(path.read_text(), piece)]
        texts += choose.sample(found, min(len(found), 8))
    trees = [parse_ruby(SourceText("s.rb", text)) for text in texts]
    certain = [bool(syntax_faults(tree)) for tree in trees]
    for text, tree, fault, valid in zip(texts, trees, certain, accepted(texts), strict=True):
        assert not (valid and fault), text
        assert valid or fault or not_understood(tree), text
    refused = [fault for fault, valid in zip(certain, accepted(texts), strict=True) if not valid]
    assert len(refused) > 5
    if piece in NEARLY_ALWAYS:
        assert sum(refused) > 0.97 * len(refused)
