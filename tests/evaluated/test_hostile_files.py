"""No file takes more than a second, or runs away with the memory; what is too much is said."""

from __future__ import annotations

import pytest

from checker.report.html.page import environment, with_code
from tests.evaluated.conftest import Measure
from tests.evaluated.files import SAID
from tests.evaluated.reading_files import ATTACKS, PICTURES

TEMPLATES = ("{{ 7 * 7 }}", "{% include '/etc/passwd' %}", "{{ ''.__class__.__mro__ }}", "${7*7}")


@pytest.mark.slow
@pytest.mark.parametrize("name", ATTACKS)
def test_it_is_read_soon_and_what_is_too_much_is_said(bounded: Measure, name: str) -> None:
    said = bounded("reading_files", name)
    assert not said.startswith("raised")
    assert SAID.get(name, "") in said


@pytest.mark.parametrize("name", PICTURES)
def test_a_picture_that_is_too_large_or_of_another_kind_is_not_drawn(
    bounded: Measure, name: str
) -> None:
    assert bounded("reading_files", name) == "None"


@pytest.mark.parametrize("text", TEMPLATES)
def test_a_name_that_reads_as_a_template_stays_text(text: str) -> None:
    assert "49" not in with_code(text)
    shown = environment().overlay(loader=None).from_string("{{ name }}").render(name=text)
    assert "49" not in shown
    assert "class &#39;" not in shown
