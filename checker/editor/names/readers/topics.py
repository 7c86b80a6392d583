"""Comparison of topics without the parts that represent the robot's name."""

from __future__ import annotations

import re
from functools import cache

from checker.base.resources import table
from checker.editor.names.readers.expressions import EXPRESSION

_MODEL = re.compile(r"(?:world/[^/]+/)?model/([^/]+)/")
_WORD = re.compile(r"[A-Za-z0-9_./~*${}()# -]+")
DERIVED = "camera_info"
"""A camera publishes it in addition to its own topic."""


def topic_key(topic: str) -> tuple[str, int]:
    """Return what topics are compared by, and where their own part begins.

    `/model/X1/odom` and `/model/#{_name}/odom` are `model/*/odom`. A name that an expression puts
    in front, as in `$(arg name)/scan`, is left out: it may be empty. The own part is what follows
    either. A leading slash means nothing to Gazebo.
    """
    start = len(topic) - len(topic.lstrip("/"))
    if of_model := _MODEL.match(topic, start):
        return f"model/*/{topic[of_model.end() :]}", of_model.end()
    first = EXPRESSION.match(topic, start)
    if first and topic[first.end() : first.end() + 1] == "/":
        return topic[first.end() + 1 :], first.end() + 1
    return topic[start:], start


def is_topic(text: str) -> bool:
    """Return whether a text may be a topic."""
    own = text.strip("/")
    return bool(own) and "//" not in text and _WORD.fullmatch(text) is not None


def own_part(key: str) -> str:
    """Return the part of a key that can be changed."""
    return key.removeprefix("model/*/")


@cache
def topics_below() -> frozenset[str]:
    """Return what sensors publish below the topic that they state: `points`."""
    sensors = table("simulated_topics")["sensors"].values()
    suffixes = (suffix for sensor in sensors for suffix, _ in sensor["topics"])
    return frozenset(it.strip("/") for it in suffixes if it.startswith("/"))


def info_topic(key: str) -> str:
    """Return the key of the `camera_info` of a topic."""
    folder, slash, _ = key.rpartition("/")
    return f"{folder}{slash}{DERIVED}"
