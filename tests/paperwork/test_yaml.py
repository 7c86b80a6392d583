"""YAML values with their places."""

from __future__ import annotations

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from checker.source.text import SourceText
from checker.source.yaml import read_yaml
from tests.effort import limited


def read(text: str):
    return read_yaml(SourceText("config.yaml", text))


def test_values_and_the_texts_they_are_marked_at():
    root = read("rate: 50  # Hz\nname: 'é'\r\nlist:\n  - 1\n  - [2.5, on]\n\n# end\n").root
    assert root.plain() == {"rate": 50, "name": "é", "list": [1, [2.5, True]]}
    assert root.get("rate").span.text == "50"
    assert root.get("name").span.text == "'é'"
    assert root.get("list").span.text == "- 1\n  - [2.5, on]"
    assert root.get("list").items[1].items[0].span.text == "2.5"
    assert root.get("nothing") is None


@pytest.mark.parametrize(
    ("text", "value"),
    [("1", 1), ("0x10", 16), ("1.0e+3", 1000.0), ("~", None), ("", None), ("yes", True),
     ("'1'", "1"), ("a b", "a b"), ("2001-12-14", "2001-12-14"), ("!!python/name:os.system", "")]
)  # fmt: skip
def test_scalars(text, value):
    read_value = read(f"a: {text}").root.get("a").scalar
    assert read_value == value
    assert type(read_value) is type(value)


def test_a_key_may_stand_twice_and_the_last_one_counts():
    root = read("a: 1\na: 2\n").root
    assert [value.scalar for _, value in root.entries] == [1, 2]
    assert root.get("a").scalar == 2


def test_aliases_and_merged_keys():
    root = read("base: &b {x: 1, y: 2}\nother: *b\nmore:\n  <<: *b\n  y: 3\n").root
    assert root.plain()["other"] == {"x": 1, "y": 2}
    assert root.plain()["more"] == {"x": 1, "y": 3}
    assert root.get("other").span.text == "*b"


@pytest.mark.parametrize(
    ("text", "at"),
    [("a: [1", 5), ("a: b: c", 4), ("\t- x", 0), ("a: *nobody", 3), ("a: &a [*a]", 7),
     ("a: !!int x", 3)]
)  # fmt: skip
def test_faults_know_their_place(text, at):
    (fault,) = read(text).faults
    assert fault.span.start == at
    assert fault.message


def test_a_small_file_cannot_stand_for_a_huge_one():
    lines = ["a0: &a0 [x, x, x, x, x, x, x, x, x, x]"]
    lines += [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 10)}]" for n in range(1, 20)]
    document = read("\n".join(lines))
    assert document.root is None
    assert len(document.faults) == 1


@pytest.mark.parametrize(
    "text", ["[" * 100_000, "{a: " * 100_000, "- " * 100_000, "? " * 50_000, "a: 1\n" * 300_000,
             "".join(f"a{n}: &a{n} [*a{n - 1}]\n" for n in range(5000))]
)  # fmt: skip
def test_hostile_files_end_in_a_fault(text):
    with limited(20):
        document = read(text)
        assert document.root is None or document.faults
        assert document.faults


@given(st.text(max_size=60) | st.text(alphabet="a1:-[]{},&*!|>'\"# \n", max_size=60))
def test_no_text_makes_the_reader_raise(text):
    document = read(text)
    if document.root is not None:
        document.root.plain()
        assert 0 <= document.root.span.start <= document.root.span.end <= len(text)


@given(
    st.recursive(
        st.none() | st.booleans() | st.integers() | st.text(alphabet="ab 1:-#'", max_size=5),
        lambda inner: (
            st.lists(inner, max_size=3)
            | st.dictionaries(st.text(alphabet="ab", min_size=1), inner, max_size=3)
        ),
        max_leaves=10,
    )
)
def test_values_are_those_that_the_library_reads(value):
    assert read(yaml.safe_dump(value)).root.plain() == value
