"""The form in which devices are described, by `devices.json` and by a user's settings."""

from __future__ import annotations

import math
import re
import warnings
from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import Any

MAX_MATCH = 200
"""Characters of a user's expression."""
MAX_CHOICES = 10
"""Choices of a user's expression: each may double the work of a search."""

_REQUIRED = ("id", "name", "kind", "match", "sdf_types", "values")
_TEXTS = ("id", "name", "kind", "match", "source", "note")
_KNOWN = (*_REQUIRED, "body", "source", "source_detail", "note", "spec_lines_in_corpus")
_REFUSED = re.compile(r"[*+{]|\(\?(?!:)|\\[1-9]")
_ESCAPED = re.compile(r"\\[^1-9]")
_CHOICE = re.compile(r"[?|]")


def _is_number(value: object) -> bool:
    """Return whether a value is a number; an integer may have more digits than a float can hold."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return False
    return math.isfinite(value) if isinstance(value, float) else abs(value) < 10**15


def _is_list(value: object, fits: Callable[[object], bool]) -> bool:
    return isinstance(value, list) and bool(value) and all(map(fits, value))


def _is_numbers(value: object) -> bool:
    return _is_list(value, _is_number)


def _is_range(value: object) -> bool:
    return isinstance(value, list) and len(value) == 2 and _is_numbers(value)


def _is_sizes(value: object) -> bool:
    return _is_list(value, _is_range)


def _is_rows(value: object) -> bool:
    return _is_number(value) or _is_numbers(value)


def _is_by_rate(value: object) -> bool:
    return isinstance(value, dict) and all(
        re.fullmatch(r"\d{1,6}(?:\.\d{1,6})?", str(rate), re.ASCII) and _is_numbers(samples)
        for rate, samples in value.items()
    )


def _is_numbers_by_name(value: object) -> bool:
    return isinstance(value, dict) and all(map(_is_number, value.values()))


def _is_sizes_by_name(value: object) -> bool:
    return isinstance(value, dict) and all(map(_is_sizes, value.values()))


_Form = tuple[Callable[[object], bool], str]
_NUMBER: _Form = (_is_number, "a number")
_NUMBERS: _Form = (_is_numbers, "a list of numbers")
_SIZES: _Form = (_is_sizes, "a list of widths and heights, such as [[640, 480]]")
_BY_NAME: _Form = (_is_numbers_by_name, "a table of numbers")
_VALUES: Mapping[str, _Form] = {
    **dict.fromkeys(("range_min", "range_max", "range_resolution", "noise_stddev"), _NUMBER),
    **dict.fromkeys(("accuracy_m", "hfov_deg", "hfov_rad", "fov_deg", "rays"), _NUMBER),
    **dict.fromkeys(("rate_max", "depth_near", "depth_far", "clip_far"), _NUMBER),
    **dict.fromkeys(("cameras", "cameras_per_device"), _NUMBER),
    **dict.fromkeys(("rates", "hfov_rad_seen", "range_min_seen", "range_max_seen"), _NUMBERS),
    **dict.fromkeys(("image_sizes", "refused_sizes"), _SIZES),
    **dict.fromkeys(("hfov_deg_by_size", "range_max_by_model", "seed_defaults"), _BY_NAME),
    **dict.fromkeys(("megapixels", "width", "megapixels_by_code", "width_by_code"), _NUMBER),
    "image_sizes_by_code": (_is_sizes_by_name, "a table of widths and heights"),
    "rows": (_is_rows, "a number or a list of numbers"),
    "vfov_deg": (_is_range, "the lowest and the highest angle"),
    "samples_by_rate": (_is_by_rate, 'a table from rates to samples, such as {"10" = [1800]}'),
    "fisheye": (lambda value: isinstance(value, bool), "true or false"),
    "plugin": (lambda value: isinstance(value, str), "a text"),
}


def _positive(value: object) -> bool:
    return isinstance(value, int | float) and _is_number(value) and value > 0


def _is_size(value: object) -> bool:
    return (
        isinstance(value, dict)
        and set(value) in ({"x", "y", "z"}, {"diameter", "height"})
        and all(map(_positive, value.values()))
    )


_BODY: Mapping[str, _Form] = {
    "mass_kg": (_positive, "a positive number"),
    "size_mm": (_is_size, "a table of x, y and z, or of diameter and height, all positive"),
}


def problem_of_device(entry: object) -> str:
    """Return what is wrong with a description of a device; empty if nothing is."""
    if not isinstance(entry, dict):
        return "is not a table"
    keys = _problem_of_keys(entry)
    if keys:
        return keys
    values = _problem_of_table("values", entry["values"], _VALUES)
    return values or _problem_of_table("body", entry.get("body", {}), _BODY)


def _problem_of_keys(entry: Mapping[str, Any]) -> str:
    for key in _REQUIRED:
        if key not in entry:
            return f"has no {key!r}"
    for key in entry:
        if key not in _KNOWN:
            return f"has the unknown key {key!r}, expected one of {', '.join(_KNOWN)}"
    for key in _TEXTS:
        if not isinstance(entry.get(key, ""), str):
            return f"has the {key} {_excerpt(entry[key])}, expected a string"
    if not _is_texts(entry["sdf_types"]):
        return f"has the sdf_types {_excerpt(entry['sdf_types'])}, expected a list of strings"
    details = entry.get("source_detail", {})
    if not isinstance(details, dict) or not _is_texts(list(details.values())):
        return f"has the source_detail {_excerpt(details)}, expected a table of strings"
    return ""


def _excerpt(value: object) -> str:
    try:
        return f"{value!r:.100}"
    except ValueError:  # a whole number of more than 4300 digits
        return "as it is"


def _is_texts(value: object) -> bool:
    return isinstance(value, list) and all(isinstance(item, str) for item in value)


def _problem_of_table(name: str, table: Any, forms: Mapping[str, _Form]) -> str:
    if not isinstance(table, dict):
        return f"has the {name} {_excerpt(table)}, expected a table"
    for key, value in table.items():
        if key not in forms:
            return f"has the unknown {name}.{key}, expected one of {', '.join(forms)}"
        fits, expected = forms[key]
        if not fits(value):
            return f"has the {name}.{key} {_excerpt(value)}, expected {expected}"
    return ""


def problem_of_match(match: str) -> str:
    """Return the reason why a user's expression is not taken; empty if it is.

    Settings are in the folder of a package, so they are not trusted. An expression without
    repetition and with few choices takes no longer than its length allows.
    """
    bare = _ESCAPED.sub("", match)
    if not match or len(match) > MAX_MATCH:
        return f"has a match of {len(match)} characters, expected 1 to {MAX_MATCH}"
    if refused := _REFUSED.search(bare):
        return (
            f"has {refused.group()!r} in its match, but repetition and look-around are not allowed"
        )
    if len(_CHOICE.findall(bare.replace("(?:", "("))) > MAX_CHOICES:
        return f"has more than {MAX_CHOICES} of '?' and '|' in its match"
    try:
        expression(match)
    except (re.error, OverflowError, RecursionError) as error:
        return f"has the match {match!r}, which is not a regular expression: {error}"
    return ""


@lru_cache(512)
def expression(match: str) -> re.Pattern[str]:
    """Return the expression by which a device is found in a text.

    Python warns of what some characters might mean in a later version; users cannot act on that.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", FutureWarning)
        return re.compile(match, re.IGNORECASE)
