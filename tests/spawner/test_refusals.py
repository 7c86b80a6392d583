"""What is outside the subset is named and never run; nothing runs away."""

import re

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from checker.expand.spawner.emitted import EmittedText
from checker.expand.spawner.reader import Unread
from tests.effort import examples, limited

from .snippets import SNIPPETS

HOSTILE = {
    "system('touch /tmp/x')": "calls system",
    "exec('ls')": "calls exec",
    "eval('1')": "calls eval",
    "fork { }": "calls fork",
    "exit": "calls exit",
    "send(:system, 'ls')": "calls send",
    "Kernel.system('ls')": "uses Kernel",
    "'a'.send(:upcase)": "calls String#send",
    "'a'.instance_eval { upcase }": "calls String#instance_eval",
    "define_method(:g) { }": "calls define_method",
    "ENV['HOME']": "uses ENV",
    "`ls`": "runs the command 'ls'",
    "`rospack find a; rm b`": "runs the command 'rospack find a; rm b'",
    "%x(ls)": "runs the command 'ls'",
    "`rospack find other_robot`.chomp": "package other_robot is not at hand",
    "File.write('/tmp/x', 'y')": "calls File.write",
    "File.open('/tmp/x', 'w') { |f| f << 'y' }": "calls File.open",
    "File.read('/etc/passwd')": "outside the workspace",
    "File.read('../x')": "relative to where Ruby runs",
    "File.read(File.join(__dir__, '../../../../etc/passwd'))": "outside the workspace",
    "require_relative '../../../x'": "outside the workspace",
    "load '/etc/x.rb'": "outside the workspace",
    "require 'net/http'": "requires 'net/http'",
    "open('|ls')": "calls open",
    "Object.const_get(:File)": "uses Object",
    "->(x) { x }": "uses a lambda",
    "'a' =~ /a/": "uses a regular expression",
    "rand": "calls rand",
    "Time.now": "uses Time",
    "@x": "uses an instance variable",
    "class A; end": "defines a class",
    "binding": "calls binding",
    "method(:f)": "calls method",
    "require 'erb'; ERB.new('x').result": "uses ERB",
    "nil.foo": "calls NilClass#foo",
    "'a'.chomp(1, 2)": "calls String#chomp, with 2 arguments",
    '"\\xff"': "escape",
    "9**99999": "bits",
    "'a' * 9_999_999": "characters",
    "[1] * 10**12": "steps",
    "(1..10**15).to_a": "steps",
    "Array.new(10**15, 1)": "steps",
    "'a'.ljust(10**12)": "characters",
    "x = 'a'; x += x while true": "steps",
    "x = ['a']; x << x while true; x": "steps",
    "loop { }": "steps",
    "while true; end": "steps",
    "10**15.times { }": "",
    "f": "calls functions more than 40 deep",
    "a = []; a << a; a.to_s": "nested too deeply",
    "a = []; a << a; a.join": "nested too deeply",
    "a = []; a << a; a.flatten": "nested too deeply",
    "a = []; a << a; b = []; b << b; a == b": "nested too deeply",
    "x = 1; 500.times { x = [x, x] }; x.to_s": "nested too deeply",
    "h = {}; h[h] = 1": "as the key of a hash",
    "h = {a: 1}; h.each { |k, v| h[v] = k }; ''": "adds to a hash",
    "[1].sort_by { |x| x }.sum": "returns Integer",
    "break": "leaves a loop",
    "3": "returns Integer",
    "raise 'stop'": "raises RuntimeError: stop",
    "raise Exception, 'x' rescue 1": "raises Exception: x",
    "YAML.load('[' * 100)": "nested too deeply",
    'YAML.load("a: &x 1\\nb: *x")': "uses an alias",
    'YAML.load("a: [")': "no YAML",
    "YAML.load(\"a: !ruby/object:A {}\")['a'].x": "calls Hash#x",
    "YAML.load(\"a: !!python/object/apply:os.system [ls]\")['a'].x": "calls Array#x",
    'YAML.load("a: 2001-01-01")': "timestamp",
    "format('%<a>s', a: 1)": "named arguments",
    "format('%9999999d', 1)": "directive",
    "format('%.3f', 1.0005)": "may round",
    "1.0.round(15)": "more than 14 digits",
    "'x'.gsub('x', '\\\\0')": "backslash",
    "'1' * '2'": "instead of an integer",
}


@pytest.mark.parametrize("code", HOSTILE)
def test_refused_with_its_reason(emit, code, monkeypatch):
    def never(*_arguments, **_options):
        pytest.fail("a command was run")

    emit("require 'yaml'\ndef f\n  YAML.load('a: 1')['a'].to_s\nend\n")  # loading runs code, too
    for name in ("os.system", "subprocess.Popen", "os.execv", "builtins.exec", "builtins.eval"):
        monkeypatch.setattr(name, never)
    with limited(20):
        result = emit(f"require 'yaml'\ndef f\n  {code}\nend\n")
    assert isinstance(result, Unread), result.text[:80]
    assert HOSTILE[code] in result.reason
    assert result.span.source.file == "robot/launch/spawner.rb"


@pytest.mark.parametrize(
    "code",
    [
        "(" * 20_000 + "1" + ")" * 20_000,
        "[" * 20_000 + "]" * 20_000,
        "if 1\n" * 3000 + "end\n" * 3000,
        "!" * 20_000 + "1",
        "'a'" + ".strip" * 20_000,
        "x = " * 5000 + "1",
        "f(" * 3000 + ")" * 3000,
        '"#{' * 2000 + '}"' * 2000,
        "{a: " * 3000 + "1" + "}" * 3000,
        "1 ? " * 3000 + "1" + ": 2" * 3000,
    ],
)
def test_deep_nesting_ends_with_a_reason(emit, code):
    with limited(5):
        result = emit(f"def f\n  {code}\nend\n")
        assert isinstance(result, Unread)


def test_what_stands_outside_the_functions_counts_for_both(workspace):
    spawner = workspace("system('ls')\ndef spawner(a)\n  'x'\nend\n").spawner()
    assert isinstance(spawner.spawn, Unread)
    assert [(u.reason, u.span.line) for u in spawner.unread] == [
        ("calls system, which is not read", 1)
    ]
    assert list(spawner.functions) == ["spawner"]


def test_one_function_can_be_read_when_the_other_cannot(workspace):
    text = "def spawner(*a)\n  ENV['x']\nend\ndef rosExecutables(a, b)\n  a + b\nend\n"
    spawner = workspace(text).spawner()
    assert isinstance(spawner.spawn, Unread)
    assert spawner.executables.text == "robot_nameworld_name"
    assert len(spawner.unread) == 1


def test_a_missing_function_is_named(workspace):
    spawner = workspace("def spawner(*a)\n  ''\nend").spawner()
    assert spawner.executables.reason == "defines no function rosExecutables"


def test_too_many_parameters(workspace):
    spawner = workspace("def rosExecutables(a, b, c)\n  ''\nend").spawner()
    assert spawner.executables.reason == (
        "raises ArgumentError: wrong number of arguments (given 2, expected 3)"
    )


def test_a_parameter_too_few_does_not_hide_what_is_emitted(workspace):
    spawner = workspace("def rosExecutables(a)\n  a\nend").spawner()
    assert spawner.executables.text == "robot_name"


def test_valid_ruby_that_the_grammar_marks_as_error_is_unread_but_no_fault(workspace):
    text = "def spawner(*a)\n  <<~X\n    #{[1].map { |i| <<~Y }.join}\n      b\n    Y\n  X\nend\n"
    spawner = workspace(text).spawner()
    assert isinstance(spawner.spawn, Unread)
    assert spawner.syntax_faults == ()


def test_an_enormous_file_is_not_parsed(workspace):
    spawner = workspace("#" * 1_000_001).spawner()
    assert "longer than" in spawner.spawn.reason


@pytest.mark.parametrize(
    "text", ["", "\n", "\ufeff", "# only\n", "end", ")", "def", "\x00", "<<A", "def f("]
)
def test_any_text_gives_a_spawner(workspace, text):
    spawner = workspace(text).spawner()
    assert isinstance(spawner.spawn, Unread)
    assert isinstance(spawner.executables, Unread)


_TOKENS = re.compile(r"\w+|\s+|[^\w\s]")
_ALL_TOKENS = sorted({token for text in SNIPPETS.values() for token in _TOKENS.findall(text)})


@settings(max_examples=examples(300), suppress_health_check=list(HealthCheck))
@given(
    st.sampled_from(sorted(SNIPPETS)),
    st.lists(
        st.tuples(st.integers(0, 500), st.integers(0, 1), st.sampled_from(["", *_ALL_TOKENS])),
        min_size=1,
        max_size=4,
    ),
)
def test_damaged_ruby_never_raises(emit, habit, damages):
    tokens = _TOKENS.findall(SNIPPETS[habit])
    for at, dropped, token in damages:
        start = at % (len(tokens) + 1)
        tokens[start : start + dropped] = [token]
    result = emit("".join(tokens))
    assert isinstance(result, (Unread, EmittedText))


def test_a_function_is_lacking_only_where_the_whole_file_was_read(workspace):
    assert workspace("def spawner(*a)\n  ''\nend").spawner().lacks("rosExecutables")
    unread = workspace("load ENV['x']\ndef spawner(*a)\n  ''\nend").spawner()
    assert not unread.lacks("rosExecutables")
