"""Spawners that mean harm: each asks for much time, much memory, or what no spawner may do."""

from __future__ import annotations

_LONG = f"b = '{'a' * 8_000}' * 50\n"
_FORTH = "m = 2**61 - 1\n"


def _parameters(count: int) -> str:
    return ",".join(f"a{number}" for number in range(count))


BODIES = {
    # What is compared
    "long texts, equal": f"{_LONG}c = 'a' * 400_000; while b == c; end",
    "long texts, sorted": f"{_LONG}c = b + 'x'; d = b + 'y'\nwhile true; ([c, d] * 5000).sort; end",
    # What is written out
    "shared arrays, nested": "a = [1]; 7.times { a = [a] * 100 }; a.to_s",
    "shared arrays, joined": "a = [1]; 7.times { a = [a] * 100 }; a.join",
    "one long text in a list of many": f"{_LONG}([b] * 40_000).join",
    "a long text, copied": f"{_LONG}while true; b.upcase; end",
    "a symbol of a long text": f"{_LONG}s = b.to_sym; while true; s.to_s; end",
    "widths in a format": "('%9999d' * 40_000) % ([1] * 40_000)",
    "precision in a format": "('%.999e' * 40_000) % ([1.5] * 40_000)",
    "long texts in a format": f"{_LONG}('%s' * 40_000) % ([b] * 40_000)",
    "many values for a format": "('%d' * 40_000) % ([1] * 900_000)",
    "a text of holes": f'{_LONG}"{"#{b}" * 2000}"',
    "a command of holes": f"{_LONG}`{'#{b}' * 2000}`",
    "wide characters": "a = []; while true; a << ('\U0001f600' * 400_000); end",
    # What is looked for
    "a text in a text": f"{_LONG}while true; b.include?('ab'); end",
    "texts in a text": f"{_LONG}while true; b.gsub('a', 'bb'); end",
    "a part of a text": f"{_LONG}while true; b[1..-2]; end",
    "a number behind blanks": "b = ' ' * 400_000\nwhile true; b.to_i; end",
    "a number that is none": f"{_LONG}while true; b.to_f; end",
    "errors that hold long texts": f"{_LONG}a = []\nwhile true\n"
    "  begin\n raise b\n rescue => e\n a << e\n end\nend",
    # What is cut to pieces
    "words": "while true; ('a ' * 200_000).split; end",
    "characters": "while true; ('a' * 400_000).split(''); end",
    "pieces that depend on a parameter": "s = 'a'; 17.times { s = s + s }\n"
    "t = _name == 'x' ? 'q' : s; while true; t.strip; end",
    # Hashes
    "a long key": f"{_LONG}h = {{}}; while true; h[b]; end",
    "keys of one hash value": f"{_FORTH}h = {{}}; i = 0; while true; i += m; h[i] = 1; end",
    "a hash that is left at once": "h = {}; 9_000.times { |i| h[i] = 1 }\n"
    "while true; h.each { break }; end",
    # Arrays
    "an array that is set behind its end": "a = []; while true; a[a.length] = a; end",
    "an array that doubles": "a = [1]; while true; a.push(*a); end",
    "an array appended to itself": "a = [1]; while true; a.concat(a, a); end",
    "an array that holds itself": "a = [1]; a << a; a.flatten",
    "an array taken apart": "a = [1] * 100_000\nwhile true; [a].each { |x, y| x }; end",
    "an array assigned to many": "a = [1] * 100_000\nwhile true; x, y, z = a; end",
    "columns of columns": "a = [1] * 100_000; while true; a = a.zip(a); end",
    "a range as a list": "(1..9_000_000).to_a",
    "a range, sorted": "while true; (1..90_000).sort; end",
    "a range beyond what can be counted": "(1..10**30).to_a",
    # Numbers
    "a power of a power": "x = 3; while true; x = x ** 3; end",
    "a sum that grows": "x = 2**999; while true; x = ([x] * 1000).sum; end",
    "a sum beyond floats": "x = 2**999; 15.times { x = ([x] * 1000).sum }; x.to_f",
    "a quotient without end": "(1e308 / 1e-10).floor.to_s",
    "an index that is not a number": "[1][0.0 / 0].to_s",
    "an integer without end": "1e400.to_i.to_s",
    "no text, many times": "x = '' * 10**30; 1",
    "no items, many times": "x = [] * 10**30; 1",
    # Paths and commands
    "a path of many folders": "b = '/workspace' + '/a' * 200_000\nwhile true; File.exist?(b); end",
    "a path of long parts": f"{_LONG}File.join(*([b] * 40_000))",
    "a command in a pipe": "open('|id')",
    "a file by IO": "IO.read('/etc/passwd')",
    "a method by its name": "Kernel.public_send(:system, 'id')",
    "a constant by its name": "Object.const_get('File')",
    "a regular expression": "'aaaaaaaaaaaaaaaaaaaaaaaaaaaa!' =~ /(a+)+$/",
    "bytes to be unpacked": "'a'.unpack('C*')",
    "all orders of a list": "[1] * 10 and (1..12).to_a.permutation.to_a",
    # Code
    "a block that is left at once": f"while true; [1].each {{ |x| next; {'x;' * 28_000} }}; end",
    "a block of many parameters": f"while true; [1].each {{ |{_parameters(8_000)}| 1 }}; end",
    "a branch that is not taken": "while true\n if _name == 'x'\n"
    + "y = 1\n" * 9_000
    + " end\nend",
    "a variable that is looked for": "if false\n z0 = 1\nend\n"
    + "y = 1\n" * 9_000
    + "while true; z0; end",
    "a heredoc in a loop": "while true; <<~X\n" + " a\n" * 19_000 + "X\nend",
    "a choice of many": "while true; case 1\n" + "when 2 then 3\n" * 4_000 + "end; end",
    "itself": "spawner(_name)",
    # YAML in it
    "YAML of many values": "y = '[' + '1,' * 20_000 + '1]'; while true; YAML.load(y); end",
    "a number of sixties": "YAML.load('1' + ':1' * 25_000)",
    "a number of many digits": "y = '0x' + 'f' * 50_000; while true; YAML.load(y); end",
    "a YAML object": "YAML.load('!ruby/object:Gem::Installer {}')",
}
_BEHIND = {
    "a first line without end": ("", f"# {'x' * 59_000}\n"),
    "heredocs, all closed": ("1\n", "<<A\nA\n" * 9_900),
    "statements": ("1\n", "1;" * 29_000),
    "parentheses": ("1\n", "(" * 59_000),
    "parentheses that close nothing": ("1\n", ")" * 59_000),
    "arguments without commas": ("1\n", "f(a b, " * 8_000),
    "literals that are never closed": ("1\n", "%q( " * 14_900),
    "backticks": ("1\n", "`" * 59_000),
    "comments that are never closed": ("1\n", "\n=begin\n" * 7_000),
    "interpolations that are never closed": ("1\n", '"#{' * 19_900),
}

SPAWNERS = {
    **{
        name: f"require 'yaml'\ndef spawner(_name, *rest)\n{body}\nend\n"
        for name, body in BODIES.items()
    },
    **{name: f"def spawner(*a)\n{body}end\n{rest}" for name, (body, rest) in _BEHIND.items()},
    "files that load files": "".join(f"require_relative 'f{n}'\n" for n in range(100)),
}
FILES = {f"robot/launch/f{number}.rb": "1;" * 29_000 for number in range(100)}
"""What the last of them loads."""
