"""The documents say what is so: tables are fresh, links lead somewhere, commands and examples run.

`pytest tests/test_docs.py --update-golden` writes the generated parts of README.md anew.
"""

from __future__ import annotations

import ast
import importlib.util
import re
import shlex
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import pytest
from markdown_it import MarkdownIt
from markdown_it.token import Token

from checker import cli
from checker.cli import arguments
from checker.engine.options import check_against_rules
from checker.engine.subject import Subject
from checker.package.inputs import open_input
from checker.rule import Rule
from checker.rule_testing import check_example, write_example
from checker.rulebook.discovery import all_rules, rules_in
from checker.rulebook.pages import parse_page
from checker.rulebook.profiles import profile, profile_names
from checker.settings import parse_settings
from tests.each import of_each

ROOT = Path(__file__).parent.parent
README = ROOT / "README.md"
USAGE = ROOT / "docs/usage.md"
DOCUMENTS = [
    README,
    ROOT / "ARCHITECTURE.md",
    ROOT / "CONTRIBUTING.md",
    ROOT / "CHANGELOG.md",
    ROOT / "samples/README.md",
    ROOT / "checker/data/README.md",
    ROOT / "editors/vscode/README.md",
    ROOT / "docs/README.md",
    ROOT / "docs/api.md",
    ROOT / "docs/editors.md",
    ROOT / "docs/github-actions.md",
    ROOT / "docs/how-a-finding-is-made.md",
    ROOT / "docs/mcp.md",
    ROOT / "docs/migrate.md",
    ROOT / "docs/oracles.md",
    ROOT / "docs/pre-commit.md",
    ROOT / "docs/robot.md",
    ROOT / "docs/ros2.md",
    ROOT / "docs/security.md",
    ROOT / "docs/service.md",
    ROOT / "docs/severity.md",
    ROOT / "docs/trial.md",
    USAGE,
]
OUR_RULES = [rule for rule in all_rules() if rule.check.__module__.startswith("rules.")]
SHOWN = ["samples/broken_rover_sensor_config_1", "--select", "GEO001,INE008,KIN001,SPW005"]
"""The check whose output README.md shows."""


def _tokens(document: Path) -> Iterator[Token]:
    for token in MarkdownIt().enable("table").parse(document.read_text("utf-8")):
        yield token
        yield from token.children or ()


def _code(document: Path, language: str) -> list[str]:
    return [
        token.content
        for token in _tokens(document)
        if token.type == "fence" and token.info == language
    ]


def _code_spans(document: Path) -> list[str]:
    return [token.content for token in _tokens(document) if token.type == "code_inline"]


def _command_lines(document: Path) -> list[str]:
    blocks = [line.strip() for block in _code(document, "sh") for line in block.splitlines()]
    return [*blocks, *_code_spans(document)]


def _part(text: str, name: str) -> re.Match[str]:
    found = re.search(rf"(?<=<!-- {name} -->\n).*?(?=<!-- /{name} -->)", text, re.DOTALL)
    assert found is not None, f"README.md has no part between <!-- {name} --> and <!-- /{name} -->"
    return found


def _assert_fresh(name: str, expected: str, request: pytest.FixtureRequest) -> None:
    text = README.read_text("utf-8")
    part = _part(text, name)
    if request.config.getoption("--update-golden"):
        README.write_text(text[: part.start()] + expected + text[part.end() :], "utf-8")
    else:
        assert part.group() == expected, "stale: pytest tests/test_docs.py --update-golden"


@pytest.mark.parametrize(("document", "most"), [(README, 150), (ROOT / "ARCHITECTURE.md", 200)])
def test_what_is_read_first_is_short(document: Path, most: int) -> None:
    assert len(document.read_text("utf-8").splitlines()) <= most


def test_readme_shows_what_the_command_prints(
    request: pytest.FixtureRequest,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(ROOT)
    assert cli.main([*SHOWN, "--color", "never"]) == 1
    printed = capsys.readouterr().out
    shown = f"```\n$ subt-check {shlex.join(SHOWN)}\n{printed}```\n"
    _assert_fresh("output", shown, request)


def test_settings_in_the_documents_are_valid() -> None:
    example, schema = _code(USAGE, "toml")
    assert schema == "#:schema ./settings.schema.json\n"
    settings = parse_settings(tomllib.loads(example), USAGE)
    check_against_rules(settings, all_rules())
    assert settings.options
    assert settings.severity


def test_the_documents_name_the_profiles_in_order() -> None:
    section = USAGE.read_text("utf-8").partition("## Profiles")[2].partition("##")[0]
    assert tuple(re.findall(r"^\| `([\w-]+)` \|", section, re.MULTILINE)) == profile_names()
    assert profile_names() == arguments.PROFILES


def test_commands_in_the_documents_are_understood() -> None:
    lines = [
        line.partition(" > ")[0]
        for document in DOCUMENTS
        for line in _command_lines(document)
        if line.startswith("subt-check ")
    ]
    parser = cli.build_parser()
    for line in lines:
        words = shlex.split(line, comments=True)[1:]
        parser.parse_args(words if words[0] in cli.COMMANDS else ["check", *words])
    used = {word for line in lines for word in line.split()}
    assert {"rule", "rules", "--format", "--profile", "--select", "--jobs", "--fail-on"} <= used


def test_make_targets_in_the_documents_exist() -> None:
    makefile = (ROOT / "Makefile").read_text("utf-8")
    targets = set(re.findall(r"^([a-z-]+):", makefile, re.MULTILINE))
    lines = [line for document in DOCUMENTS for line in _command_lines(document)]
    named = {line.split()[1] for line in lines if line.startswith("make ")}
    assert {"demo", "test"} <= named
    assert named <= targets


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: str(path.relative_to(ROOT)))
def test_relative_links_lead_to_files(document: Path) -> None:
    links = [str(t.attrGet("href")) for t in _tokens(document) if t.type == "link_open"]
    local = [link.partition("#") for link in links if not link.startswith("https://")]
    dead = [path for path, _, _ in local if not (document.parent / path).exists()]
    assert not dead
    for path, _, anchor in local:
        target = document.parent / path if path else document
        assert not anchor or anchor in _anchors(target)


def _anchors(document: Path) -> set[str]:
    headings = re.findall(r"^#+ (.+)$", document.read_text("utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("document", ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md"])
def test_paths_in_the_documents_exist(document: str) -> None:
    ours = re.compile(r"(?:checker|rules|samples|tests|bench|scripts|\.ci)/[\w./-]*")
    named = [span for span in _code_spans(ROOT / document) if ours.fullmatch(span)]
    assert not [path for path in named if not (ROOT / path).exists()]


def _defined(file: Path) -> set[str]:
    """Return the names that a module defines, those of methods behind their class."""
    names = set()
    for node in ast.parse(file.read_text("utf-8")).body:
        match node:
            case ast.ClassDef(name=name, body=body):
                methods = (it.name for it in body if isinstance(it, ast.FunctionDef))
                names |= {name, *(f"{name}.{method}" for method in methods)}
            case ast.FunctionDef(name=name) | ast.AnnAssign(target=ast.Name(id=name)):
                names.add(name)
            case ast.Assign(targets=targets):
                names |= {it.id for it in targets if isinstance(it, ast.Name)}
    return names


def test_the_way_of_a_finding_names_what_exists() -> None:
    page = ROOT / "docs/how-a-finding-is-made.md"
    links = re.findall(r"\[`([\w.]+)`\]\((\S+\.py)\)", page.read_text("utf-8"))
    assert len(links) > 30
    gone = [link for link in links if link[0] not in _defined(page.parent / link[1])]
    assert not gone


def test_architecture_names_parts_that_rules_need() -> None:
    section = (ROOT / "ARCHITECTURE.md").read_text("utf-8").partition("## A rule")[2]
    rows = re.findall(r"^  \| (`.+?) \|", section.partition("\n## ")[0], re.MULTILINE)
    listed = [name for row in rows for name in re.findall(r"\w+", row)]
    needed = {re.split(r"\W", kind)[-1] for rule in OUR_RULES for kind in rule.needs.values()}
    assert len(listed) > 30
    assert needed >= {*listed}


def test_architecture_names_every_folder() -> None:
    folders = {f"checker/{p.name}/" for p in (ROOT / "checker").iterdir() if p.is_dir()}
    folders.discard("checker/__pycache__/")
    assert folders <= set(_code_spans(ROOT / "ARCHITECTURE.md"))


def test_every_table_of_facts_is_listed() -> None:
    listed = (ROOT / "checker/data/README.md").read_text("utf-8")
    tables = [path.name for path in (ROOT / "checker/data").glob("*.json")]
    assert not [name for name in tables if _family(name) not in listed]


def _family(table: str) -> str:
    return re.sub(r"(?<=^sdf_spec_)[\d.]+(?=\.json$)", "<version>", table)


@of_each("rule", OUR_RULES, ids=lambda rule: rule.id)
def test_every_rule_has_a_page(rule: Rule) -> None:
    assert_page(rule)


def assert_page(rule: Rule) -> None:
    first = rule.page.partition("\n\n")[0]
    assert re.fullmatch(r"[A-Z`][^\n|<>]{10,98}[^\s.,:;!?…]\.", first)
    page = parse_page(rule.page)
    assert page.why
    assert page.fix
    assert page.source
    assert page.reason.endswith(".")


@of_each("rule", OUR_RULES, ids=lambda rule: rule.id)
def test_every_rule_is_where_its_id_says(rule: Rule) -> None:
    module = rule.check.__module__.rpartition(".")[2]
    assert module.startswith(f"{rule.id.lower()}_")
    assert re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)+", rule.name)
    assert any(profile(name).includes(rule) for name in profile_names())


def _loaded(code: str, file: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    file.write_text(code, "utf-8")
    spec = importlib.util.spec_from_file_location(file.stem, file)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    monkeypatch.setitem(sys.modules, file.stem, module)
    spec.loader.exec_module(module)
    return module


def test_the_part_in_contributing_works(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    _, code = _code(ROOT / "CONTRIBUTING.md", "python")
    module = _loaded(code, tmp_path / "calibration.py", monkeypatch)
    for files, reason in (
        ({}, "config/calibration.yaml does not exist"),
        ({"config/calibration.yaml": "fx: 1.5"}, None),
    ):
        with open_input(write_example(files, tmp_path / str(len(files)))) as opened:
            had = Subject(opened.packages[0]).one(module.Calibration)
        assert getattr(had, "reason", None) == reason


def test_the_rule_in_contributing_works(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    code, _ = _code(ROOT / "CONTRIBUTING.md", "python")
    file = tmp_path / "kin900_stiff_spring.py"
    _loaded(code, file, monkeypatch)
    (rule,) = rules_in(file.stem)
    assert_page(rule)
    for kind in ("good", "bad"):
        for example in getattr(rule, kind):
            check_example(rule, kind, example, tmp_path / kind)
