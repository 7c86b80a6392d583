"""The schema: every version loads, and walks over any document."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.base.words import Suggestions
from checker.formats.sdf.schema import VERSIONS, ElementType, all_tags, sdf_root, walk
from tests.model.robots import document

ANYTHING = "<p:q/><anything><at/></anything>"


@pytest.mark.parametrize("version", VERSIONS)
def test_a_version_loads(version: str) -> None:
    root = sdf_root(version)
    assert root.name == "sdf"
    assert root.attributes["version"]
    assert {"link", "joint", "plugin"} <= root.children["model"].children.keys()
    assert root.children["model"].children["plugin"].free
    assert {"sdf", "gravity", "ixx"} <= all_tags(version)


@pytest.mark.parametrize("version", VERSIONS)
def test_a_version_tells_what_it_added(version: str) -> None:
    number = tuple(int(part) for part in version.split("."))
    model = sdf_root(version).children["model"]
    # Nested models came with 1.5, the attribute relative_to with 1.7, merging with 1.9.
    assert ("model" in model.children) == (number >= (1, 5))
    pose = model.children["link"].children["pose"]
    assert ("relative_to" in pose.attributes) == (number >= (1, 7))
    assert ("degrees" in pose.attributes) == (number >= (1, 9))
    include = model.children.get("include")
    assert (include is not None and "merge" in include.attributes) == (number >= (1, 9))


def test_a_version_that_is_not_known_is_read_as_1_6() -> None:
    assert sdf_root("9.9").version == "1.6"


@pytest.mark.parametrize("version", VERSIONS)
def test_every_place_of_a_version_can_be_reached(version: str) -> None:
    seen: set[tuple[int, ...]] = set()
    stack = [sdf_root(version)]
    while stack:
        kind = stack.pop()
        place = (id(kind.description), *(id(outer) for outer in kind.enclosing))
        if place not in seen:
            seen.add(place)
            stack.extend(kind.children.values())
    assert len(seen) > 2000


def test_models_nest_without_end() -> None:
    text = '<sdf version="1.8">' + "<model>" * 100 + "<bad/>" + "</model>" * 100 + "</sdf>"
    kinds = [kind for _, kind in walk(document(text).root, "1.8")]
    assert kinds[-1] is None
    assert all(kind is not None and kind.name == "model" for kind in kinds[1:-1])


@st.composite
def known(draw: st.DrawFn, kind: ElementType, depth: int = 0) -> str:
    """An element as the schema allows it, with elements that no schema knows among its children."""
    if kind.free:
        return f"<{kind.name}>{ANYTHING}</{kind.name}>"
    inside = []
    children = sorted(kind.children.values(), key=lambda child: child.name)
    if depth < 6 and children:
        chosen = draw(st.lists(st.sampled_from(children), max_size=3))
        inside = [draw(known(child, depth + 1)) for child in chosen]
    inside += draw(
        st.lists(st.sampled_from(["<bad><pose/></bad>", "<x:y><bad/></x:y>"]), max_size=1)
    )
    return f"<{kind.name}>{''.join(inside)}</{kind.name}>"


@given(st.data(), st.sampled_from(VERSIONS))
def test_walk_tells_known_from_unknown(data: st.DataObject, version: str) -> None:
    root = document(data.draw(known(sdf_root(version)))).root
    walked = list(walk(root, version))
    for element, kind in walked:
        assert (kind is None) == (element.tag == "bad")
        assert kind is None or kind.name == element.tag
    positions = [element.position.start for element, _ in walked]
    assert positions == sorted(positions)
    unknown = [element for element, kind in walked if kind is None]
    # Nothing below an element with a prefix or a plugin is looked at.
    assert len(unknown) == len(
        root.document.find_all("//bad[not(ancestor::*[contains(name(), ':')])]")
    )


def test_the_nearest_word() -> None:
    suggestions = Suggestions(all_tags("1.6"))
    assert suggestions.closest("horizondal_fov") == "horizontal_fov"
    assert suggestions.closest("zebra") is None
