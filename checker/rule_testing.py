"""The rule kit: examples of rules, made into packages, and checked.

An example is an XML fragment for model.sdf, or a mapping from paths to texts that change a minimal
package: `None` removes a file, bytes are written as they are, `../other/…` is in a sibling. Names
with `@` mean:

- `@fragment`: a fragment for model.sdf.
- `@robot`: the name of a shared robot (`ROBOTS`) that becomes model.sdf.
- `@change`: a mapping of texts in model.sdf to what takes their place.
- `@name`: the name of the package's folder.
- `@links`: symbolic links, each with its target.
- `@urdf`: a URDF package instead: an arm of one joint, its controller and its launch files. The
  text takes the place of the arm's transmission and plugin; True leaves these as they are.
- `@ros2`: a ROS 2 package instead: an arm in xacro, a YAML file, and `launch/arm.launch.py`, whose
  launch description contains the text; True starts the arm alone.
- `@bridge`: a ROS 2 package instead: a rover with a lidar, the launch file that starts Gazebo,
  spawns it and bridges its topics, and `config/bridge.yaml`, whose place the text takes.
- `@launch`: a mapping of texts in the launch file of that package to what takes their place.
- `@mjcf`: a folder with a model of MuJoCo instead: `arm.xml`, whose `<mujoco>` contains the text.
- `@with`: ids of rules that run along.
- `@profile`: the profile that judges it instead of the first one that has the rule.
- `@reported`: what must be reported where no marker is possible.

The marker `^ SEN005` is on the line that must be reported. Rules of other distributions are
tested by the same two functions of `subt_check.rule_testing`::

    @pytest.mark.parametrize(("rule", "kind", "example"), examples_of(rules_in("acme_rules")))
    def test_example(rule, kind, example, tmp_path):
        check_example(rule, kind, example, tmp_path)
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from checker.base.cache import Cache, cache_folder
from checker.engine.judge import Judge
from checker.engine.review import run_and_set_aside
from checker.engine.subject import Subject
from checker.package.inputs import open_input
from checker.report.report import Cause
from checker.rule import Rule
from checker.rulebook.discovery import all_rules, rules_in
from checker.rulebook.example_files import ROBOTS, Example, example_package
from checker.rulebook.profiles import Profile, profile, profile_names
from checker.settings import find_settings

__all__ = ["ROBOTS", "Example", "check_example", "examples_of", "rules_in", "write_example"]


def profile_of(rule: Rule, example: Example = "") -> Profile:
    """Return the profile that judges an example: of those that have the rule, the first."""
    if isinstance(example, Mapping) and "@profile" in example:
        return profile(example["@profile"])
    return next(judge for judge in map(profile, profile_names()) if judge.includes(rule))


def write_example(example: Example, workspace: Path) -> Path:
    """Write the package of an example below a folder and return its own folder."""
    made = example_package(example)
    package = workspace / made.name
    for path, content in made.files.items():
        target = package / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(content if isinstance(content, bytes) else content.encode())
    for path, text in made.links.items():
        (package / path).symlink_to(text)
    return package


def expected_places(example: Example, rule: str, package: Path) -> set[str]:
    """Return `file:line` of all that must be reported."""
    places = set(example.get("@reported", ())) if isinstance(example, Mapping) else set()
    for file in package.rglob("*"):
        if file.is_file():
            for number, line in enumerate(file.read_text("utf-8", "replace").splitlines(), 1):
                if f"^ {rule}" in line:
                    places.add(f"{file.relative_to(package).as_posix()}:{number}")
    return places


def examples_of(rules: Sequence[Rule]) -> Iterator[tuple[Rule, str, Example]]:
    """Yield each example of some rules with its rule and its kind, `good` or `bad`."""
    for rule in rules:
        for kind in ("good", "bad"):
            for example in getattr(rule, kind):
                yield rule, kind, example


def check_example(rule: Rule, kind: str, example: Example, folder: Path) -> None:
    """Run a rule on one of its examples: a bad one is reported at its marks, a good one nowhere.

    Args:
        rule: The rule of the example.
        kind: `good` or `bad`.
        example: As the module's docstring describes it.
        folder: An empty folder; the package is written below it.

    Raises:
        AssertionError: The rule did not look, or reported other lines than those with a mark.
    """
    package = write_example(example, folder)
    with open_input(package) as opened:
        settings = find_settings([package]).with_overrides(thorough=True)
        cache = Cache(cache_folder())
        subject = Subject(opened.packages[0], cache, xacro_args=settings.xacro_args)
        rules = [rule, *_companions(example)]
        judge = Judge(profile_of(rule, example), settings)
        outcome = run_and_set_aside(rules, all_rules(), subject, judge)
        subject.close()
    for skipped in outcome.not_checked:
        if skipped.rule == rule.id and skipped.cause is not Cause.NOT_APPLICABLE:
            raise AssertionError(f"{rule.id} did not look at its example: {skipped.reason}")
    reported = {
        f"{place.file or '.'}:{place.line}"
        for finding in outcome.findings
        if finding.rule == rule.id
        for place in finding.places
        if not place.note
    }
    expected = expected_places(example, rule.id, package)
    if reported != expected:
        raise AssertionError(f"{rule.id} reports {sorted(reported)}, expected {sorted(expected)}")
    if bool(expected) is not (kind == "bad"):
        marks = "no mark" if kind == "bad" else "a mark"
        raise AssertionError(f"a {kind} example of {rule.id} has {marks} `^ {rule.id}`")


def _companions(example: Example) -> list[Rule]:
    """Return the rules that run along."""
    names = example.get("@with", ()) if isinstance(example, Mapping) else ()
    return [rule for rule in all_rules() if rule.id in names]
