"""Addresses of services are read, and what is none is refused."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.base.errors import CheckerError
from checker.service.client.server import Server, parse_server


@pytest.mark.parametrize(
    ("text", "server"),
    [
        ("https://check.example", Server("https", "check.example", 443)),
        ("https://check.example/", Server("https", "check.example", 443)),
        ("HTTP://Check.Example:8000/subt/", Server("http", "check.example", 8000, "/subt")),
        ("http://[::1]:80", Server("http", "::1", 80)),
        ("https://prüfung.example", Server("https", "xn--prfung-4ya.example", 443)),
        (" https://check.example\n", Server("https", "check.example", 443)),
    ],
)
def test_an_address(text: str, server: Server) -> None:
    assert parse_server(text) == server


@pytest.mark.parametrize(
    "text",
    [
        *(
            "",
            "check.example",
            "check.example:8000",
            "ftp://check.example",
            "https://",
            "http:///x",
        ),
        *("https://ann:secret@check.example", "https://check.example?x=1", "https://a.example#x"),
        *("http://a.example:99999", "http://[::1", "http://a.example/a b", "http://a.example/ü"),
        *("http://a.example/\r\nHost: b", "http://" + "a" * 300 + ".example", "http://a..b"),
    ],
)
def test_what_is_no_address(text: str) -> None:
    with pytest.raises(CheckerError, match=r"is no address of a service, .* https://check\.exam"):
        parse_server(text)


@given(st.text(max_size=30))
def test_any_text_is_an_address_that_is_read_as_itself_or_refused(text: str) -> None:
    for said in (text, f"http://{text}", f"https://a.example{text}"):
        try:
            server = parse_server(said)
        except CheckerError:
            continue
        assert parse_server(str(server)) == server
        assert str(server).isascii()
        assert str(server).isprintable()


@pytest.mark.parametrize("host", ["localhost", "127.0.0.1", "127.8.0.1", "[::1]"])
def test_this_machine_is_here(host: str) -> None:
    assert parse_server(f"http://{host}:8000").is_here


@pytest.mark.parametrize("host", ["check.example", "192.168.0.1", "localhost.example", "8.8.8.8"])
def test_other_machines_are_not(host: str) -> None:
    assert not parse_server(f"http://{host}:8000").is_here
