"""Lines that specifications.md names no longer contain what it says.

Reviewers look up each limit at the line that specifications.md names. Line numbers become
wrong with the next edit of the file, or come from another robot's sheet. One line above and below
is allowed.

Fix: correct the line numbers, or name the parameter instead: `max_velocity` in spawner.rb.
Source: SubT sheets state the file and line of each limit; authors write these numbers by hand.
"""

import posixpath
import re
from collections.abc import Iterator, Sequence
from itertools import islice

from checker.model.specification.motion import Limit
from checker.model.specification.sheet import Specification
from checker.model.specification.sheet_text import LineReference
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked
from checker.source.text import SourceText

_LIMITS = ("vel", "accel", "effort", "limit", "lower", "upper", "speed", "steer", "power")
TAGS = (
    (r"velocit|speed", ("vel", "speed")),
    (r"accelerat", ("accel",)),
    (r"torque|effort|force", ("effort", "torque", "force")),
    (r"turning radius|steering|knuckle", ("steer", "radius", "wheel_base", "upper", "lower")),
    (r"\bangle|rotation", ("lower", "upper", "angle", "angular", "steer")),
    (r"spring", ("spring",)),
    (r"damping", ("damping",)),
    (r"friction", ("friction", "mu")),
    (r"batter|endurance|run ?time", ("power_load", "capacity", "charge", "battery")),
    (r"colou?r", ("ambient", "diffuse", "specular", "emissive", "colo")),
    (r"\bmass|weight", ("mass",)),
    (r"limit|constraint", _LIMITS),
)
"""Words of a sheet, and parts of the names of parameters that they may mean."""

_EARLIER = re.compile(r".*\blines?\s+\d[\d\s,to&–-]*(?:and\s+\d+)?", re.IGNORECASE)
_NUMBER = re.compile(r"(?<![\w.])-?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?(?!\w)", re.IGNORECASE)
_LONGEST = 400
_MOST_LINES = 200
MOST_REFERENCES = 200


@rule("DOC005", "stale-line-reference", Severity.WARNING, Concern.PAPERWORK)
def check(
    package: Package, specification: Specification, *, around: int = 1, tolerance: float = 0.02
) -> Findings:
    """Read the lines that specifications.md names and the adjacent lines, and search for the claim.

    Options:
        around: Lines that are read above and below those that specifications.md names.
        tolerance: Share of the larger number by which a limit in specifications.md and a number in
            the lines may differ.
    """
    for reference in specification.line_references[:MOST_REFERENCES]:
        path = _path(package, specification, reference.file.value)
        source = package.read(path) if path else None
        if not isinstance(source, SourceText):
            yield unchecked(
                f"{reference.file.value}, which specifications.md names, is not available"
            )
            continue
        text = "\n".join(_lines(source, reference, around)).casefold()
        tags = _tags(reference)
        where = f"{path}, {_lines_phrase(reference)}"
        if not text:
            yield finding(
                reference,
                f"specifications.md names {where}, but the file has {_length(source)} lines",
            )
        elif tags and not any(tag in text for tag in tags):
            yield finding(
                reference,
                f"specifications.md refers to {where} for {_expected_subject(reference)}, but "
                "these lines do not contain it",
            )
        elif wrong := _other_number(_claimed_limit(specification, reference), text, tolerance):
            yield finding(
                reference,
                f"specifications.md refers to {where} for a limit of {wrong}, but the lines "
                "contain other numbers",
            )


def _path(package: Package, sheet: Specification, written: str) -> str | None:
    """Return the file that a sheet means, which names it from its own folder or by its name."""
    folder = posixpath.dirname(sheet.source.file)
    for path in (written, f"launch/{written}"):
        if package.exists(joined := posixpath.normpath(posixpath.join(folder, path))):
            return joined
    name = posixpath.basename(written)
    named = [file.path for file in package.index.files if posixpath.basename(file.path) == name]
    return named[0] if len(named) == 1 else None


def _lines(source: SourceText, reference: LineReference, around: int) -> Iterator[str]:
    """Yield the lines that are named, those around among them, 200 at most."""
    last_line = _length(source)
    numbers = (
        number
        for first, last in reference.ranges
        if first <= last_line
        for number in range(max(first - around, 1), min(last + around, last_line) + 1)
    )
    for number in islice(numbers, _MOST_LINES):
        yield source.line(number)[:_LONGEST]


def _length(source: SourceText) -> int:
    return source.text.count("\n") + (not source.text.endswith("\n"))


def _claim(reference: LineReference) -> str:
    """Return the words of this reference alone, without those of one in front of it."""
    return _EARLIER.sub("", reference.claim).casefold()


def _tags(reference: LineReference) -> Sequence[str]:
    claim = _claim(reference)
    if not re.search(r"\w{3}", claim):
        return _LIMITS
    return [tag for words, tags in TAGS if re.search(words, claim) for tag in tags]


def _expected_subject(reference: LineReference) -> str:
    claim = _claim(reference)
    matches = (re.search(words, claim) for words, _ in TAGS)
    words = dict.fromkeys(_whole_word(claim, text) for text in matches if text)
    return " or ".join(words) or "a limit"


def _whole_word(text: str, match: re.Match[str]) -> str:
    rest = re.match(r"\w*", text[match.end() :])
    return match.group() + (rest.group() if rest else "")


def _claimed_limit(sheet: Specification, reference: LineReference) -> Limit | None:
    """Return the last limit that the sheet states on the same line in front of a reference."""
    start = reference.span.start
    text = sheet.source.text
    before = [
        limit
        for limit in sheet.limits
        if limit.span.end <= start and "\n" not in text[limit.span.end : start]
    ]
    return before[-1] if before else None


def _other_number(limit: Limit | None, text: str, tolerance: float) -> str:
    """Return the number that the lines should hold and do not; empty if they do."""
    numbers = [abs(float(number)) for number in _NUMBER.findall(text)]
    if limit is None or not numbers:
        return ""
    wanted = {abs(bound) for bound in (limit.minimum, limit.maximum) if bound is not None}
    near = any(abs(n - bound) <= tolerance * max(bound, n) for n in numbers for bound in wanted)
    return "" if near else f"{limit.maximum:g}"


def _lines_phrase(reference: LineReference) -> str:
    ranges = [str(a) if a == b else f"{a}-{b}" for a, b in reference.ranges]
    return f"{'line' if len(ranges) == 1 and '-' not in ranges[0] else 'lines'} {', '.join(ranges)}"


_MODEL = """<joint name="w" type="revolute">
  <parent>base_link</parent>
  <child>wheel</child>
  <axis>
    <limit>
      <effort>20</effort>
      <velocity>5</velocity>
    </limit>
  </axis>
</joint>
<link name="wheel"/>
"""
_HEAD = "# Rover\n### Motion Characteristics\n"
_MARK = " <!-- ^ DOC005 -->"


def _example(line: str) -> dict[str, str]:
    return {"@fragment": _MODEL, "specifications.md": f"{_HEAD}{line}\n"}


GOOD = [
    _example("* Front wheel velocity and torque &mdash; model.sdf, lines 10 and 11"),
    _example("* Front wheel velocity and torque &mdash; model.sdf, lines 11-13"),
    _example("* What follows stands in model.sdf, line 2"),
    _example("* Velocity of up to 5 m/s (model.sdf, lines 10 and 11)"),
    _example("* model.sdf, lines 8-12"),
]
BAD = [
    _example(f"* Front wheel velocity and torque &mdash; model.sdf, lines 5 and 6{_MARK}"),
    _example(f"* Velocity limits in `model.sdf`, lines 1415 and 1417{_MARK}"),
    _example(f"* _x_ velocity range from -1 m/s to 1 m/s (model.sdf, line 11){_MARK}"),
    _example(f"* model.sdf, lines 1-3{_MARK}"),
]
