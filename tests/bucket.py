"""A server of S3 for tests, from PyPI (moto): one of them, a bucket of its own for each test."""

from __future__ import annotations

import secrets
from collections.abc import Iterator
from urllib.request import Request, urlopen

import pytest

VARIABLES = {
    "AWS_ACCESS_KEY_ID": "test",
    "AWS_SECRET_ACCESS_KEY": "test",
    "AWS_REGION": "us-east-1",
}


@pytest.fixture(scope="session")
def object_store() -> Iterator[str]:
    """The address of the server."""
    server = pytest.importorskip("moto.server").ThreadedMotoServer("127.0.0.1", 0, verbose=False)
    server.start()
    yield "http://{}:{}".format(*server.get_host_and_port())
    server.stop()


@pytest.fixture
def bucket_url(object_store: str, monkeypatch: pytest.MonkeyPatch) -> str:
    """A prefix in a new bucket, with the variables that lead to it set."""
    for name, value in (VARIABLES | {"AWS_ENDPOINT_URL": object_store}).items():
        monkeypatch.setenv(name, value)
    bucket = f"bucket-{secrets.token_hex(4)}"
    with urlopen(Request(f"{object_store}/{bucket}", method="PUT")) as answer:  # noqa: S310
        assert answer.status == 200
    return f"s3://{bucket}/some/prefix"
