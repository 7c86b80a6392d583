"""The upload form says what it holds, whatever names and texts are in it."""

from __future__ import annotations

import email
from email.message import Message
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.service.client.form import Form

HOSTILE = ('a"; filename="b', "x\r\nContent-Type: text/html\r\n\r\n", "--", "ü\u202e.zip", "\ud800")
TEXT = st.sampled_from(HOSTILE) | st.text(st.characters(exclude_categories=()), max_size=20)


def parts_of(form: Form) -> list[Message]:
    body = b"".join(form.pieces())
    assert len(body) == form.length
    head = f"Content-Type: {form.content_type}\r\n\r\n".encode()
    parts = email.message_from_bytes(head + body).get_payload()
    assert isinstance(parts, list)
    return parts


@given(content=st.binary(max_size=200), name=TEXT, profile=st.text("abc-", max_size=9))
def test_a_form_is_read_as_it_was_written(
    content: bytes, name: str, profile: str, tmp_path_factory: pytest.TempPathFactory
) -> None:
    file = tmp_path_factory.mktemp("form") / "file"
    file.write_bytes(content)
    text, sent = parts_of(Form(file, name, {"profile": profile}))
    assert text.get_param("name", header="content-disposition") == "profile"
    assert text.get_payload(decode=True) == profile.encode()
    assert sent.get_param("name", header="content-disposition") == "file"
    assert len(sent.items()) == 2
    assert b"".join(Form(file, name).pieces()).count(content) >= 1


def test_a_large_file_is_sent_in_pieces_and_counted(tmp_path: Path) -> None:
    file = tmp_path / "large.zip"
    with file.open("wb") as sparse:
        sparse.truncate(50_000_000)
    told: list[int] = []
    form = Form(file, file.name, told=told.append)
    sizes = [len(piece) for piece in form.pieces()]
    assert sum(sizes) == form.length
    assert max(sizes) <= 65536
    assert told == sorted(told)
    assert told[-1] == 50_000_000
