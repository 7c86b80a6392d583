"""The upload form, piece by piece: how it is cut makes no difference, and nothing breaks it."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import pytest
from blake3 import blake3
from hypothesis import given
from hypothesis import strategies as st

from checker.service.store.store import Store, TooLarge
from checker.service.web.answers.refusal import Refused
from checker.service.web.uploads.form import (
    FIELD_LIMIT,
    LENGTH_LIMIT,
    PARTS_LIMIT,
    UploadForm,
    safe_name,
    signature_mismatch,
)
from tests.web.server import BOUNDARY, form, left_behind

TYPE = f"multipart/form-data; boundary={BOUNDARY}"
ZIP = b"PK\x03\x04" + b"\r\n--limit-of\r\n--limit-of-part" * 40


@pytest.fixture(scope="module")
def store() -> Iterator[Store]:
    with tempfile.TemporaryDirectory() as folder:
        yield Store(Path(folder))


def sent(store: Store, body: bytes, cuts: list[int], kind: str = TYPE) -> tuple[str, UploadForm]:
    """Return the hash of the file in a form that comes in pieces, and the form."""
    ends = sorted({min(cut, len(body)) for cut in cuts} | {len(body)})
    with store.incoming(1_000_000) as incoming:
        taken = UploadForm(kind, incoming.write, lambda _: None)
        for start, end in zip([0, *ends], ends, strict=False):
            if body[start:end]:
                taken.feed(body[start:end])
        taken.end()
        return incoming.finish(), taken


@given(st.lists(st.integers(0, 3_000), max_size=30))
def test_a_form_is_the_same_however_it_is_cut(store: Store, cuts: list[int]) -> None:
    body = form("rover.zip", ZIP, {"profile": "sdf"})
    hash, taken = sent(store, body, cuts)
    assert hash == blake3(ZIP).hexdigest()
    assert (taken.name, taken.fields) == ("rover.zip", {"profile": "sdf"})


def test_a_form_is_the_same_byte_by_byte(store: Store) -> None:
    body = form("rover.zip", ZIP)
    hash, _ = sent(store, body, list(range(len(body))))
    assert hash == blake3(ZIP).hexdigest()


NOISE = st.binary(max_size=300) | st.sampled_from(
    [form("rover.zip", ZIP), form("a\x00.zip", ZIP), b"--" + BOUNDARY.encode(), b"\r\n\r\n", b"--"]
)


@given(st.lists(NOISE, max_size=5), st.sampled_from([TYPE, "", "multipart/form-data", "a;b=c;;"]))
def test_noise_is_refused_in_words(store: Store, pieces: list[bytes], kind: str) -> None:
    before = len(left_behind(store))
    with suppress(Refused), store.incoming(1_000_000) as incoming:
        taken = UploadForm(kind, incoming.write, lambda _: None)
        for piece in filter(None, pieces):
            taken.feed(piece)
        taken.end()
    assert len(left_behind(store)) == before


@given(st.text(max_size=50))
def test_a_name_is_made_safe_or_refused(store: Store, name: str) -> None:
    shown = name.encode("utf-8", "replace").decode().replace('"', "%22")
    body = form(f"{shown}.zip".replace("\r", "").replace("\n", ""), ZIP)
    with suppress(Refused):
        _, taken = sent(store, body, [])
        assert (
            taken.name.removesuffix(".zip")
            .replace("-", "")
            .replace("_", "")
            .replace(".", "")
            .isalnum()
        )
        assert len(taken.name.encode()) <= LENGTH_LIMIT


@pytest.mark.parametrize("name", ["機器人.zip", "Käfer_é.urdf", "робот-2.tar.gz"])
def test_letters_of_all_languages_are_kept(name: str) -> None:
    assert safe_name(name) == name


def test_a_long_name_keeps_whole_letters() -> None:
    short = safe_name(f"{'機' * 200}.zip")
    assert short.startswith("機機")
    assert short.endswith(".zip")
    assert len(short.encode()) <= LENGTH_LIMIT


TWO_FILES = form("a.zip", ZIP).removesuffix(f"--{BOUNDARY}--\r\n".encode()) + form("b.zip", ZIP)
ELSEWHERE = form("a.zip", ZIP).replace(b'name="file"', b'name="other"')


@pytest.mark.parametrize(
    ("body", "status", "said"),
    [
        (b"", 400, "ends early"),
        (form("rover.zip", ZIP)[:-9], 400, "ends early"),
        (f"--{BOUNDARY}--\r\n".encode(), 422, "contains no file"),
        (form("", b""), 422, "No file is chosen"),
        (form("rover.zip", b""), 422, "rover.zip is empty"),
        (TWO_FILES, 400, "more than one file"),
        (ELSEWHERE, 400, "another field"),
        (form("rover.exe", ZIP), 415, "does not end in"),
        (form("rover.zip", b"hello"), 415, "has the name of a zip archive"),
        (form("rover.tar.gz", ZIP), 415, "has the name of a gzipped tar archive"),
        (form("rover.sdf", b"\x7fELF"), 415, "has the name of an XML text"),
        (form("rover.zip", ZIP, {"a": "x" * (FIELD_LIMIT + 1)}), 400, "longer than"),
        (form("rover.zip", ZIP, {f"f{n}": "" for n in range(PARTS_LIMIT)}), 400, "segment count"),
    ],
)
def test_what_is_wrong_with_a_form_is_said(
    store: Store, body: bytes, status: int, said: str
) -> None:
    with pytest.raises(Refused) as refused:
        sent(store, body, [])
    assert refused.value.status == status
    assert said in refused.value.error


def test_another_kind_of_body_is_refused(store: Store) -> None:
    with pytest.raises(Refused) as refused:
        sent(store, b"{}", [], "application/json")
    assert refused.value.status == 415


def test_who_may_not_send_is_refused_before_the_first_byte_of_the_file(store: Store) -> None:
    def nobody(_: object) -> None:
        raise Refused(401, "", "")

    body = form("rover.zip", ZIP)
    with store.incoming(1_000_000) as incoming:
        with pytest.raises(Refused):
            UploadForm(TYPE, incoming.write, nobody).feed(body)
        assert incoming.size == 0


def test_the_limit_is_the_files(store: Store) -> None:
    with store.incoming(len(ZIP)) as incoming:
        UploadForm(TYPE, incoming.write, lambda _: None).feed(form("rover.zip", ZIP))
    with store.incoming(len(ZIP) - 1) as incoming, pytest.raises(TooLarge):
        UploadForm(TYPE, incoming.write, lambda _: None).feed(form("rover.zip", ZIP))


@pytest.mark.parametrize(
    ("name", "head", "fits"),
    [
        ("A.ZIP", b"PK\x03\x04", True),
        ("a.zip", b"\x1f\x8b", False),
        ("a.tgz", b"\x1f\x8b\x08", True),
        ("a.tar.gz", b"ustar", False),
        ("a.sdf", b"\xef\xbb\xbf\n  <sdf>", True),
        ("a.urdf", "<robot>".encode("utf-16"), True),
        ("a.xacro", b"robot:", False),
        ("a.world", b"", False),
    ],
)
def test_the_first_bytes_tell_the_kind(name: str, head: bytes, fits: bool) -> None:
    assert (signature_mismatch(name, head) == "") is fits
