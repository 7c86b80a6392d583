"""Convex polygons in the plane: around points, and how far inside a point is."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import pairwise

Point = tuple[float, float]


def convex_hull(points: Iterable[Point]) -> tuple[Point, ...]:
    """Return the corners of the convex hull, counter-clockwise (Andrew's monotone chain).

    Of points on one line, the two ends; of one point, itself.
    """
    ordered = sorted(set(points))
    if len(ordered) < 3:
        return tuple(ordered)
    below, above = _chain(ordered), _chain(ordered[::-1])
    return (*below[:-1], *above[:-1])


def _chain(points: Sequence[Point]) -> list[Point]:
    """Return the points at which a walk along one side turns left."""
    chain: list[Point] = []
    for point in points:
        while len(chain) > 1 and _turn(chain[-2], chain[-1], point) <= 0.0:
            chain.pop()
        chain.append(point)
    return chain


def _turn(a: Point, b: Point, c: Point) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def margin(polygon: Sequence[Point], point: Point) -> float:
    """Return the distance of a point from the edges of a polygon; negative when it is outside.

    Args:
        polygon: Corners of a convex polygon, counter-clockwise, at least one.
        point: In the units of the corners.
    """
    if len(polygon) == 1:
        return -math.dist(polygon[0], point)
    edges = list(pairwise((*polygon, polygon[0])))
    distance = min(_distance(a, b, point) for a, b in edges)
    inside = len(polygon) > 2 and all(_turn(a, b, point) >= 0.0 for a, b in edges)
    return distance if inside else -distance


def _distance(a: Point, b: Point, point: Point) -> float:
    """Return the distance of a point from a line that ends at a and b."""
    along = (b[0] - a[0], b[1] - a[1])
    square = along[0] ** 2 + along[1] ** 2
    if square == 0.0:
        return math.dist(a, point)
    share = ((point[0] - a[0]) * along[0] + (point[1] - a[1]) * along[1]) / square
    share = min(max(share, 0.0), 1.0)
    return math.dist((a[0] + share * along[0], a[1] + share * along[1]), point)
