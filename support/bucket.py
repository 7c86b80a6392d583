"""A server of S3 for tests, from PyPI (moto): one server, a separate bucket for each test."""

from __future__ import annotations

import logging
import secrets
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from urllib.request import Request, urlopen

import pytest

KEYS = {
    "AWS_ACCESS_KEY_ID": "test",
    "AWS_SECRET_ACCESS_KEY": "test",
    "AWS_REGION": "us-east-1",
}


@contextmanager
def server_of_s3() -> Iterator[str]:
    """Start a server, and yield its address."""
    logging.getLogger("werkzeug").setLevel(logging.ERROR)  # a line for each request
    server = pytest.importorskip("moto.server").ThreadedMotoServer("127.0.0.1", 0, verbose=False)
    server.start()
    yield "http://{}:{}".format(*server.get_host_and_port())
    server.stop()


def bucket_of(server: str) -> Mapping[str, str]:
    """Make a bucket, and return the variables that lead to a prefix in it."""
    bucket = f"bucket-{secrets.token_hex(4)}"
    with urlopen(Request(f"{server}/{bucket}", method="PUT")) as answer:  # noqa: S310
        assert answer.status == 200
    return KEYS | {"AWS_ENDPOINT_URL": server, "SUBT_CHECK_STORE": f"s3://{bucket}/some/prefix"}


@pytest.fixture(scope="session")
def object_store() -> Iterator[str]:
    """The address of the server."""
    with server_of_s3() as address:
        yield address


@pytest.fixture
def bucket_url(object_store: str, monkeypatch: pytest.MonkeyPatch) -> str:
    """A prefix in a new bucket, with the variables that lead to it set."""
    variables = bucket_of(object_store)
    for name in (*KEYS, "AWS_ENDPOINT_URL"):
        monkeypatch.setenv(name, variables[name])
    return variables["SUBT_CHECK_STORE"]
