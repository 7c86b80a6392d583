"""CMakeLists.txt: its language, and what it declares."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.source.cmake import read_cmake
from checker.source.text import SourceText
from tests.effort import large, limited

PIECES = st.lists(
    st.sampled_from(
        ["set(", "a", " ", ")", "(", '"', "\\", "#", "[[", "]]", "${", "}", ";", "\n", "if(x)",
         "endif()", "foreach(d a b)", "endforeach()", "install(FILES ", "DESTINATION "]
    )
).map("".join)  # fmt: skip


def read(text: str):
    return read_cmake(SourceText("CMakeLists.txt", text))


def words(text: str):
    """The words of the only call in a text, and the texts they are marked at."""
    file = read(text)
    assert file.faults == ()
    (call,) = file.calls
    return [(word.value, word.span.text) for word in call.arguments]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("f(a b)", [("a", "a"), ("b", "b")]),
        ("F (a\n b # c)\n)", [("a", "a"), ("b", "b")]),
        ("f(a #[[ b\n ]] c)", [("a", "a"), ("c", "c")]),
        ("f(#[=[ ]] ]=] a)", [("a", "a")]),
        ('f("a b" "")', [("a b", "a b"), ("", "")]),
        ('f("a\\\nb")', [("ab", "a\\\nb")]),
        ('f("a\\"b\\n")', [('a"b\n', 'a\\"b\\n')]),
        ("f([[a)b]] [=[c]]d]=])", [("a)b", "a)b"), ("c]]d", "c]]d")]),
        ("f(a\\ b)", [("a b", "a\\ b")]),
        ("f(a;b)", [("a", "a;b"), ("b", "a;b")]),
        ('f("a;b")', [("a;b", "a;b")]),
        ("f(a (b c))", [("a", "a"), ("(", "("), ("b", "b"), ("c", "c"), (")", ")")]),
        ("f(${CATKIN}/x)", [("${CATKIN}/x", "${CATKIN}/x")]),
        ("\ufefff(a)", [("a", "a")]),
    ],
)
def test_arguments(text, expected):
    assert words(text) == expected


def test_a_command_name_is_read_in_any_case():
    assert read("PROJECT(x)").project.value == "x"


@pytest.mark.parametrize(
    ("text", "marked"),
    [
        ("f(a", "f"),
        ('f("a', '"'),
        ("f([=[a]]", "[=["),
        ("#[[ a", "#[["),
        ("f", "f"),
        (")", ")"),
        ("f g()", "f"),
        ('"a"()', "a"),
        ("a-b()", "a-b"),
        ("if(x)", "if"),
        ("endif()", "endif"),
        ("foreach(x a)\nendif()\nendforeach()", "endif"),
    ],
)
def test_what_is_not_closed_or_misplaced_is_a_fault_where_it_begins(text, marked):
    fault = read(text).faults[0]
    assert fault.span.text == marked
    assert fault.message


def test_project_packages_and_libraries():
    file = read(
        "project(rover_sensor_config_1 VERSION 1.0)\nfind_package(catkin REQUIRED)\n"
        "ign_find_package(ignition-plugin1)\nadd_library(${PROJECT_NAME}_drive SHARED a.cc)\n"
    )
    assert file.project.value == "rover_sensor_config_1"
    assert file.project.span.line == 1
    assert [call.arguments[0].value for call in file.find_packages] == [
        "catkin",
        "ignition-plugin1",
    ]
    (library,) = file.libraries
    assert library.name.value == "rover_sensor_config_1_drive"
    assert library.name.span.text == "${PROJECT_NAME}_drive"
    assert [word.value for word in library.sources] == ["SHARED", "a.cc"]


def test_an_install_names_its_items_and_where_they_go():
    file = read(
        "install(DIRECTORY launch ${CMAKE_CURRENT_SOURCE_DIR}/meshes/\n"
        "  DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION} USE_SOURCE_PERMISSIONS)\n"
        "install(FILES model.sdf DESTINATION share)\n"
        'install(DIRECTORY . DESTINATION x PATTERN "*.orig" EXCLUDE)\n'
        "install(TARGETS drive LIBRARY DESTINATION lib)\n"
        "install(CODE [[message(x)]])\n"
    )
    assert [
        (each.kind, [item.value for item in each.items], each.destination, each.filtered)
        for each in file.installs
    ] == [
        ("DIRECTORY", ["launch", "meshes/"], "${CATKIN_PACKAGE_SHARE_DESTINATION}", False),
        ("FILES", ["model.sdf"], "share", False),
        ("DIRECTORY", ["."], "x", True),
        ("TARGETS", ["drive"], "lib", False),
    ]
    assert file.installs[0].items[0].span.text == "launch"


def test_variables_are_put_in_where_they_are_known():
    text = (
        "set(DIRS launch meshes)\nlist(APPEND DIRS urdf)\ninstall(DIRECTORY ${DIRS} DESTINATION d)"
    )
    assert [item.value for item in read(text).installs[0].items] == ["launch", "meshes", "urdf"]
    assert {item.span.text for item in read(text).installs[0].items} == {"${DIRS}"}


@pytest.mark.parametrize(
    "header", ["foreach(d launch meshes)", "set(L launch meshes)\nforeach(d IN LISTS L)",
               "foreach(d IN ITEMS launch meshes)"]
)  # fmt: skip
def test_a_loop_over_words_is_unrolled(header):
    file = read(f"{header}\n  install(DIRECTORY ${{d}}/ DESTINATION s/${{d}})\nendforeach()")
    assert [(each.items[0].value, each.destination) for each in file.installs] == [
        ("launch/", "s/launch"),
        ("meshes/", "s/meshes"),
    ]
    assert not any(each.conditional for each in file.installs)


@pytest.mark.parametrize("header", ["foreach(d ${UNKNOWN})", "foreach(i RANGE 3)"])
def test_a_loop_over_what_is_not_known_runs_once_and_is_conditional(header):
    (install,) = read(f"{header}\ninstall(FILES ${{d}} DESTINATION s)\nendforeach()").installs
    assert (install.items[0].value, install.conditional) == ("${d}", True)


def test_what_stands_inside_if_is_conditional_and_its_variables_are_not_known():
    file = read("set(a 1)\nif(x)\nset(a 2)\ninstall(FILES f)\nendif()\ninstall(FILES ${a})")
    assert [(each.items[0].value, each.conditional) for each in file.installs] == [
        ("f", True),
        ("${a}", False),
    ]


@pytest.mark.slow
@pytest.mark.parametrize(
    "text",
    [
        "a(" + "(" * large(100_000),
        "a(" + "(" * large(100_000) + ")" * (large(100_000) + 1),
        'x("' * large(50_000),
        "[[" * large(50_000),
        "${" * large(100_000),
        "a(" + "x " * large(100_000) + ")",
        "a(" + "${" * large(50_000) + ")",
        "x" * large(1_000_000),
        "if()\n" * large(20_000),
        "set(a x)\n" + 'set(a "${a}${a}")\n' * 1000,
        "set(a " + "x" * 9000 + ")\nb(" + "${a}" * large(100_000) + ")",
        "foreach(a 1 2 3 4 5 6 7 8 9 10)\n" * 30 + "m(${a})\n" + "endforeach()\n" * 30,
        "foreach(a 1)\n" * 5000 + "endforeach()\n" * 5000,
    ],
)
def test_hostile_files_take_little_time_and_memory(text):
    with limited(large(20)):
        file = read(text)
    assert len(file.calls) <= 20_000


@given(st.text(max_size=100) | PIECES)
def test_no_text_makes_the_reader_raise(text):
    file = read(text)
    for call in file.calls:
        assert all(0 <= word.span.start <= word.span.end <= len(text) for word in call.arguments)
    assert all(fault.span.end <= len(text) for fault in file.faults)
    assert all(install.kind for install in file.installs)


def test_every_real_file_is_read_without_fault(corpus: Path):
    paths = sorted(corpus.glob("*/CMakeLists.txt"))
    assert len(paths) == 18
    for path in paths:
        file = read(path.read_text())
        assert file.faults == ()
        assert file.project.value == path.parent.name
        assert [call.arguments[0].value for call in file.find_packages] == ["catkin"]
        directories = [item.value for item in file.installs[0].items]
        assert "launch" in directories
        assert all((path.parent / directory).is_dir() for directory in directories)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("install(TARGETS a DESTINATION lib)", ["lib"]),
        ("install(TARGETS b a ARCHIVE DESTINATION x LIBRARY DESTINATION lib/p)", ["lib/p"]),
        (
            "install(TARGETS a RUNTIME DESTINATION bin)\ninstall(TARGETS a DESTINATION y)",
            ["y"],
        ),
        ("install(TARGETS b EXPORT a LIBRARY DESTINATION lib)", []),
        ("install(FILES a DESTINATION lib)", []),
        ("install(TARGETS a LIBRARY DESTINATION)", []),
    ],
)
def test_where_a_library_is_installed(text, expected):
    assert list(read(text).library_destinations("a")) == expected


def test_folders_that_ament_auto_installs():
    text = "project(p)\nament_auto_package(USE_SCOPED INSTALL_TO_SHARE launch urdf OTHER x)"
    (install,) = read(text).installs
    assert [item.value for item in install.items] == ["launch", "urdf"]
    assert (install.kind, install.destination) == ("DIRECTORY", "share/p")
    assert read("ament_auto_package()").installs == ()
