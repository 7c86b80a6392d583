"""Files that mean harm, and what is said of each; a text on its own says that it does no harm."""

from __future__ import annotations


def _args(value: str) -> str:
    """Return args of which each is made of the one before."""
    first = f'<arg name="a0" default="{"x" * 100}"/>'
    return first + "".join(
        f'<arg name="a{n + 1}" default="{value.format(n=n)}"/>' for n in range(40)
    )


def _eval(expression: str) -> str:
    return f'<arg name="a" value="$(eval {expression})"/>'


_LONG_ARG = f'<arg name="a" default="{"x" * 19_000}"/>'
_WORDS_ARG = f'<arg name="a" default="{"/x@y[z " * 2_500}"/>'

LAUNCH = {
    "args that double by eval": _args("$(eval a{n} + a{n})"),
    "args that double": _args("$(arg a{n})$(arg a{n})"),
    "eval: a power of powers": _eval("9**9**9"),
    "eval: a shift": _eval("1 &lt;&lt; 10**9"),
    "eval: a text, many times": _eval("'a' * 10**9"),
    "eval: an import": _eval("__import__('os').system('id')"),
    "eval: all classes": _eval("().__class__.__bases__[0].__subclasses__()"),
    "eval: a comprehension": _eval("[x for x in range(10**9)]"),
    "eval: a format": _eval("'{0.__class__}'.format(1)"),
    "eval: a lambda": _eval("(lambda: 1)()"),
    "eval: parentheses": _eval("(" * 190 + "1" + ")" * 190),
    "eval: signs": _eval("-" * 390 + "1"),
    "params of a long arg": _LONG_ARG + '<param name="p" value="$(arg a)"/>' * 20_000,
    "bridges of a long arg": _WORDS_ARG
    + '<node pkg="ros_ign_bridge" type="parameter_bridge" name="n" args="$(arg a)"/>' * 5_000,
    "substitutions that are never closed": f'<param name="p" value="{"$( " * 300_000}"/>',
}
YAML = {
    "a number of many sixties": "a: 1" + ":1" * 400_000,
    "a broken number of many sixties": "a: 1" + ":1" * 400_000 + ".5",
    "a number of a million digits": "a: 0x" + "f" * 900_000,
    "many values": "[" + "1," * 400_000 + "1]",
    "aliases of aliases": "a0: &a0 [1,1,1,1,1,1,1,1,1]\n"
    + "".join(f"a{n + 1}: &a{n + 1} [{','.join([f'*a{n}'] * 9)}]\n" for n in range(9)),
    "merges of merges": "a0: &a0 {k: 1}\n"
    + "".join(f"a{n + 1}: &a{n + 1} {{<<: *a{n}, x: *a{n}}}\n" for n in range(60)),
    "brackets": "[" * 400_000,
    "a list in a list": "- " * 450_000,
    "a Python object": 'a: !!python/object/apply:os.system ["id"]',
}
CMAKE = {
    "a loop over many words": f"foreach(i {'a ' * 3000})\nset(x {'b ' * 100_000})\nendforeach()",
    "a loop over a long list": f"set(x {'b ' * 4000})\nforeach(i IN LISTS x x x)\n"
    "foreach(j IN LISTS x x x)\nset(y ${x})\nendforeach()\nendforeach()",
    "a variable that doubles": "set(x b)\n" + 'set(x "${x}${x}")\n' * 1000,
}
SETTINGS = {
    "a key of many parts": ".".join(["a"] * 90_000) + " = 1",
    "a key of many quoted parts": "rules." + ".".join(['"!"'] * 40_000) + " = 1",
    "a number of 5000 digits": f"trial = {'1' * 5000}",
    "a long number in base 16": f"trial = 0x{'f' * 9000}",
    "lists in lists": f"select = {'[' * 90_000}",
    "a device found by repetition": '[[devices]]\nid="a"\nname="a"\nkind="a"\nsdf_types=["a"]\n'
    'values={}\nmatch="(a+)+b"',
    "a baseline elsewhere": 'baseline = "../../../../etc/passwd"',
    "a key without end": f"{'a' * 190_000} = 1",
}
MARKDOWN = {
    "a heading of marks": f"# {'= ' * 100_000}x\n",
    "links that are never closed": "[" * 50_000,
    "comments that are never closed": "<!-- " * 40_000,
    "tags that are never closed": "<a " * 60_000,
}
NUMBERS = {
    "digits, and no number": "1" * 400_000 + "x",
    "digits and a point, and no number": "1" * 200_000 + "." + "1" * 200_000 + "e",
}
SAID = {
    **dict.fromkeys(NUMBERS, "is not a number"),
    "args that double by eval": "more than",
    "args that double": "more than",
    "params of a long arg": "steps to evaluate",
    "bridges of a long arg": "steps to evaluate",
    "a number of many sixties": "is not of type",
    "a broken number of many sixties": "is not of type",
    "a number of a million digits": "is not of type",
    "many values": "too many values",
    "aliases of aliases": "too many values",
    "merges of merges": "too many values",
    "brackets": "nested more than",
    "a list in a list": "nested more than",
    "a loop over many words": "steps to evaluate",
    "a loop over a long list": "steps to evaluate",
    "a key of many parts": "more than 20 parts",
    "a key of many quoted parts": "more than 20 parts",
    "a number of 5000 digits": "Exceeds the limit",
    "a long number in base 16": "more than 300 digits",
    "lists in lists": "nested too deeply",
    "a device found by repetition": "repetition and look-around are not allowed",
    "a baseline elsewhere": "expected the path of a file in or below",
    "a key without end": "unknown key",
    **{name: "$(eval" for name in LAUNCH if name.startswith("eval: ")},
    "eval: parentheses": "",
}
