"""What is outside the subset is named and never run; nothing runs away."""

import re

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from checker.launch.spawner.reader import Unread
from checker.source.emitted import EmittedText
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
    "`rospack find other_robot`.chomp": "package other_robot is not available",
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
    "x = 'a'; while true; x += x; end": "steps",
    "x = ['a']; while true; x << x; end; x": "steps",
    "while true; end": "steps",
    "10**15.times { }": "",
    "f": "calls functions more than 40 deep",
    "a = []; a << a; a.to_s": "nested too deeply",
    "a = []; a << a; a.join": "nested too deeply",
    "a = []; a << a; a.flatten": "nested too deeply",
    "a = []; a << a; b = []; b << b; a == b": "compares two values of the class Array",
    "x = 1; 500.times { x = [x, x] }; x.to_s": "nested too deeply",
    "h = {}; h[h] = 1": "as the key of a hash",
    "h = {a: 1}; h.each { |k, v| h[v] = k }; ''": "adds to a hash",
    "[1].map { |x| x }.sum": "returns Integer",
    "break": "leaves a loop",
    "3": "returns Integer",
    "raise 'stop'": "raises RuntimeError: stop",
    "begin; raise Exception, 'x'; rescue; 1; end": "raises Exception: x",
    "YAML.load('[' * 100)": "nested too deeply",
    'YAML.load("a: &x 1\\nb: *x")': "uses an alias",
    'YAML.load("a: [")': "is not YAML that can be read",
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

NOT_SUPPORTED = {
    "''": "center chop each_char each_line gsub! index lines ljust reverse rjust strip! succ tr",
    "[]": "at delete each_slice inject insert sort_by transpose uniq unshift each_with_object",
    "{}": "delete each_key each_value find_all sort_by store to_h transform_values update",
    "(1..2)": "begin cover? each_slice end step",
    "1": "between? clamp digits div divmod downto fdiv modulo negative? pred succ",
    "1.5": "divmod finite? nan? truncate",
    ":a": "length name to_proc",
    "nil": "to_a to_f to_i",
    "Math": "cbrt exp log log10",
    "File": "absolute_path exists? extname file? open readlines write",
    "YAML": "dump load_stream parse unsafe_load",
}
"""Methods of Ruby that spawners do not call, by a receiver."""

OUTSIDE = {
    "x = ?a": "uses '?a', which is not supported",
    "x = %i[a b]": "uses '%i[a b]', which is not supported",
    "x = :'a b'": "uses ':'a b'', which is not supported",
    "x = 0x1f": "uses the number 0x1f, which is not decimal",
    "x = 017": "uses the number 017, which is not decimal",
    '"\\e"': "uses the escape \\e, which is not supported",
    "x = (raise 'a' rescue 1)": "uses 'raise 'a' rescue 1', which is not supported",
    "begin; 1; ensure; 2; end": "uses ensure, which is not supported",
    "begin; 1; end while true": "uses 'begin; 1; end while true', which is not supported",
    "a, *b = [1, 2]": "assigns to '*b', which is not supported",
    "(a, b), c = [1, 2], 3": "assigns to '(a, b)', which is not supported",
    "case 1; when 0..2 then 1; end": "compares with a Range in a case",
    "case 1; when Integer then 1; end": "compares with a Class in a case",
    "[1, 2].each { |a, *b| 1 }": "has the block parameter *b",
    "f(**{})": "uses '**{}', which is not supported",
    "x = {**{}}": "contains a hash entry that is not supported",
    "f({a: 1}, 'b' => 2)": "passes 'b' => 2, which is not supported",
    "[[1]] == [[1]]": "compares two values of the class Array",
    "{[1] => 2}": "uses Array as the key of a hash",
    "a = []; a[3] = 1": "sets an element beyond the end of an array",
    "\"#{['a']}\"": "writes out a value of the class String in an array, which is not supported",
    '"#{{a: 1}}"': "writes out a value of the class Hash, which is not supported",
    "format('%x', 1)": "with the directive %x",
    "1.round(-2)": "or less than none",
    "yield": "uses yield",
    "1.is_a?(StandardError)": "calls Integer#is_a?, which is not supported",
}


def test_a_method_outside_the_subset_is_named_with_its_line(emit):
    for receiver, methods in NOT_SUPPORTED.items():
        for method in methods.split():
            result = emit(f"def f\n  x = {receiver}\n  x.{method}\n  ''\nend")
            assert isinstance(result, Unread), (receiver, method)
            assert re.fullmatch(
                rf"calls \w+[#.]{re.escape(method)}, which is not supported", result.reason
            )
            assert (result.span.line, result.span.text) == (3, f"x.{method}")


def test_a_construct_outside_the_subset_is_named(emit):
    for code, reason in OUTSIDE.items():
        result = emit(f"def f(*a)\n  {code}\n  ''\nend")
        assert isinstance(result, Unread), code
        assert reason in result.reason, code
        assert result.span.line == 2


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


@pytest.mark.slow
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
        ("calls system, which is not supported", 1)
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
