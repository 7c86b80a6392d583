"""Nothing in the checker evaluates, loads or opens a stranger's text but what is known here."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pytest

from tests.evaluated.dangers import dangers_in

ROOT = Path(__file__).parents[2]
FILES = sorted([*ROOT.glob("checker/**/*.py"), *ROOT.glob("rules/**/*.py")])

CODE, MODULE = "code made of a text", "a module by its name"
ATTRIBUTE, PATTERN = "an attribute by its name", "a pattern that is put together"
YAML = "YAML that makes objects"
TEMPLATE, FORMAT = "a template made of a text", "a format that is put together"
XPATH, GLOB = "an XPath that is put together", "a pattern of file names"
BYTES = "a module that makes objects of bytes"

ALLOWED: Mapping[tuple[str, str], str] = {
    ("checker/base/sandbox/account.py", BYTES): "a system call that gives up rights",
    ("checker/base/sandbox/landlock.py", BYTES): "system calls that enter the sandbox",
    ("checker/base/sandbox/namespaces.py", BYTES): "system calls that enter the sandbox",
    ("checker/base/sandbox/seccomp.py", BYTES): "system calls that enter the sandbox",
    ("checker/base/sandbox/windows_job.py", BYTES): "system calls that set limits",
    ("checker/base/system.py", ATTRIBUTE): "limits of the system, named by our own code",
    ("checker/base/sandbox/task.py", BYTES): "a system call that ends it with its parent",
    ("checker/base/sandbox/launcher_process.py", BYTES): "a system call that hands orphans over",
    ("checker/base/sandbox/task.py", MODULE): "named by the parent, before anything is read",
    ("checker/engine/subject.py", MODULE): "our own, and those of the types that rules ask for",
    ("checker/package/formats.py", MODULE): "a list of our own formats",
    ("checker/physics/mesh/trimesh_files.py", "a mesh by its suffix"): "one of four, named there",
    ("checker/rulebook/discovery.py", MODULE): "the modules of installed packages of rules",
    ("checker/rulebook/rule_index.py", MODULE): "those that the index of installed rules names",
    ("checker/cli/doctor/library_imports.py", MODULE): "what our own distribution requires",
    ("checker/service/jobs/check_child.py", MODULE): "a list of our own modules",
    ("checker/editor/plugin_facts.py", PATTERN): "a list of our own, of Classic's drives",
    ("checker/cli/check/arguments.py", ATTRIBUTE): "options of the command line, named there",
    ("checker/base/record.py", ATTRIBUTE): "fields of our own records",
    ("checker/__init__.py", MODULE): "the modules of the API, named there",
    ("checker/cli/__init__.py", MODULE): "the modules of commands, named there",
    ("checker/rule_testing.py", ATTRIBUTE): "the two kinds of examples, named there",
    (
        "checker/physics/trial/simulation/simulation.py",
        ATTRIBUTE,
    ): "warnings of MuJoCo that are named there",
    ("checker/service/store/s3.py", "an archive unpacked unseen"): (
        "packed by a worker from files that it had named; zipfile makes no links"
    ),
    ("checker/service/logs.py", ATTRIBUTE): "a constant",
    ("checker/formats/xacro/processor.py", ATTRIBUTE): "functions of xacro, named there",
    ("checker/formats/xacro/symbols.py", ATTRIBUTE): "functions of math, named there",
    (
        "checker/formats/xacro/expression/evaluation.py",
        ATTRIBUTE,
    ): "keys of YAML, as xacro looks them up",
    (
        "checker/formats/xacro/expression/syntax.py",
        ATTRIBUTE,
    ): "fields of a syntax tree, named there",
    ("checker/formats/xacro/expression/methods.py", ATTRIBUTE): "of plain data, named there",
    (
        "checker/formats/xacro/symbols.py",
        PATTERN,
    ): "xacro's own, of characters that cannot break out of it",
    ("checker/formats/xacro/expression/format.py", FORMAT): "without look-ups, of plain data alone",
    ("checker/formats/xacro/yaml_values.py", YAML): "a subclass of the safe loader, bounded",
    ("checker/service/jobs/check_child.py", PATTERN): "a folder of ours, escaped",
    ("checker/migrate/new_package.py", PATTERN): "tags that are named there",
    (
        "checker/model/devices/form.py",
        PATTERN,
    ): "a user's: no repetition, few choices",
    ("checker/model/devices/devices.py", PATTERN): "of our table of devices",
    ("checker/model/locomotion/classic.py", PATTERN): "of our table of plugins",
    ("checker/ros/wiring/inputs.py", PATTERN): "of our table of nodes, escaped",
    ("checker/package/teams.py", PATTERN): "of our table of teams",
    ("checker/model/plugin_library.py", PATTERN): "of our table of plugins",
    ("checker/source/xml_errors.py", PATTERN): "a name, escaped",
    ("checker/launch/spawner/literals.py", PATTERN): "quotes of a literal, escaped",
    ("rules/documentation/doc005_stale_line_reference.py", PATTERN): "words that are named there",
    ("checker/report/html/launches.py", PATTERN): "a name, escaped",
    ("rules/package/pkg007_undeclared_dependency.py", PATTERN): "packages that are named there",
    ("rules/ros/ros005_unusual_ros_name.py", PATTERN): "of our table of channels",
    ("checker/report/scene/drawing/studio.py", TEMPLATE): "no template: MuJoCo's XML of our studio",
    ("checker/physics/compiled/worker.py", TEMPLATE): "no template: MuJoCo's XML, with limits",
    ("checker/cli/init.py", TEMPLATE): "of our own folder `templates`",
    ("checker/source/xml.py", XPATH): "every caller writes it out, which is tested as well",
    (
        "checker/rulebook/suppression/entries.py",
        GLOB,
    ): "a user's: 200 of 1000 characters, none goes back",
    ("checker/package/installed.py", GLOB): "part by part of a path, 200 characters",
    ("rules/package/pkg008_resource_not_installed.py", GLOB): "100 patterns of 100 characters",
    ("rules/package/pkg011_junk_file.py", GLOB): "names of junk, named there",
    ("rules/geometry/geo006_uneven_wheel_heights.py", FORMAT): "one of two texts, named there",
    ("rules/geometry/geo015_overlapping_collisions.py", FORMAT): "an example of the rule",
}
"""By file and danger: why it is none there."""

INNOCENT = (
    "import yaml\nyaml.compose(text, Loader=yaml.CSafeLoader)",
    "Image.open(file, formats=('PNG',))",
    "etree.XMLParser(resolve_entities=False, no_network=True)",
    "Environment(loader=loader, autoescape=True)",
    "re.compile('a')",
    "subprocess.run(['ls'])",
)
GUILTY = (
    *("eval(text)", "exec(text)", "compile(text, '', 'exec')", "__import__(name)"),
    *("import pickle", "from marshal import loads", "import shelve", "from ctypes import CDLL"),
    *("os.system(text)", "os.popen(text)", "subprocess.run(text, shell=True)", "os.execv(a, b)"),
    *("yaml.load(text)", "yaml.unsafe_load(text)", "yaml.compose(text)"),
    *("Image.open(file)", "Image.open(file, formats=None)"),
    *("jinja2.Template(text)", "environment.from_string(text)", "Environment(loader=loader)"),
    *("importlib.import_module(name)", "getattr(thing, name)", "setattr(thing, name, 1)"),
    *("etree.fromstring(text)", "etree.parse(file)", "ET.fromstring(text)", "minidom.parse(file)"),
    "etree.XMLParser(no_network=True)",
    "etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=True)",
    *("document.find_all(f'link[{name}]')", "etree.XPath(name)", "tree.xpath('a' + name)"),
    *("np.load(file)", "np.loadtxt(file)", "trimesh.load(file)", "archive.extractall(folder)"),
    *("text.format(name)", "text.format_map(names)", "datetime.strptime(a, b)"),
    *("re.search(text, name)", "fnmatch(name, text)", "tempfile.mktemp()"),
)


@pytest.fixture(scope="module")
def found() -> Mapping[tuple[str, str], str]:
    """By file and danger: the last place of it."""
    return {
        (path, danger): f"{path}:{line}: {danger}"
        for path in (file.relative_to(ROOT).as_posix() for file in FILES)
        for danger, line in dangers_in((ROOT / path).read_text("utf-8"))
    }


def test_every_danger_is_known_and_has_its_reason(found: Mapping[tuple[str, str], str]) -> None:
    assert not [place for key, place in found.items() if key not in ALLOWED]


def test_what_is_allowed_is_still_there(found: Mapping[tuple[str, str], str]) -> None:
    assert not ALLOWED.keys() - found.keys()


@pytest.mark.parametrize("text", GUILTY)
def test_a_danger_is_seen(text: str) -> None:
    assert list(dangers_in(f"def function():\n    {text}"))


@pytest.mark.parametrize("text", INNOCENT)
def test_what_is_safe_is_let_be(text: str) -> None:
    assert not list(dangers_in(text))
