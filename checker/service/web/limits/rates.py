"""Rate limits of one client, and of all clients."""

from __future__ import annotations

import ipaddress
from collections import Counter, OrderedDict
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from time import monotonic

import msgspec
from starlette.requests import HTTPConnection

from checker.base.record import Record

CLIENTS = 10_000
"""Greatest number of remembered clients; a new one replaces the least recent."""
_IPV6_HOME = 64
"""Bits of an address that one client has: the rest it may choose again for each request."""


def client_of(connection: HTTPConnection) -> str:
    """Return the client for whom a request counts."""
    return network_of(connection.client.host if connection.client else "")


def network_of(host: str) -> str:
    """Return the client of an address: itself if it is IPv4, its network if it is IPv6."""
    try:
        address = ipaddress.ip_address(host.partition("%")[0])
    except ValueError:
        return host[:100]
    if isinstance(address, ipaddress.IPv4Address):
        return str(address)
    if address.ipv4_mapped is not None:
        return str(address.ipv4_mapped)
    return str(ipaddress.ip_network((address, _IPV6_HOME), strict=False))


@dataclass
class Bucket:
    """Drops of a client and when they were counted (token bucket)."""

    drops: float
    counted: float


class Rate(Record):
    """Rate limit of each client per minute, which it may use all at once.

    Attributes:
        per_minute: Zero for any number.
        now: A clock, in seconds.
    """

    per_minute: int
    now: Callable[[], float] = monotonic
    _buckets: OrderedDict[str, Bucket] = msgspec.field(default_factory=OrderedDict)

    def wait(self, client: str, count: int = 1) -> float:
        """Count one more for a client, and return 0; or the seconds until it may.

        Args:
            client: The client for whom it counts.
            count: Zero to query only.
        """
        if not self.per_minute:
            return 0.0
        now, per_second = self.now(), self.per_minute / 60
        bucket = self._buckets.pop(client, None) or Bucket(self.per_minute, now)
        full = float(self.per_minute)
        drops = min(full, bucket.drops + (now - bucket.counted) * per_second)
        allowed = drops >= 1
        self._buckets[client] = Bucket(drops - count if allowed else drops, now)
        if len(self._buckets) > CLIENTS:
            self._buckets.popitem(last=False)
        return 0.0 if allowed else (1 - drops) / per_second


class Slots(Record):
    """Places for simultaneous work.

    Attributes:
        all: Places.
        per_client: The number for one client.
    """

    all: int
    per_client: int
    _taken: Counter[str] = msgspec.field(default_factory=Counter)

    @contextmanager
    def one(self, client: str) -> Iterator[bool]:
        """Hold a place; False if there is none."""
        free = self._taken.total() < self.all and self._taken[client] < self.per_client
        self._taken[client] += free
        try:
            yield free
        finally:
            self._taken[client] -= free
            if not self._taken[client]:
                del self._taken[client]
