"""Names of macros, as the tags of calls without the prefix `xacro:` have them."""

from __future__ import annotations

import re
from collections.abc import Iterable

OF_URDF = frozenset(
    {
        *("axis", "box", "calibration", "collision", "color", "cylinder", "dynamics", "gazebo"),
        *("geometry", "inertia", "inertial", "joint", "limit", "link", "mass", "material", "mesh"),
        *("mimic", "origin", "plugin", "robot", "safety_controller", "sensor", "sphere"),
        *("transmission", "visual", "ros2_control", "hardware", "param"),
    }
)
_MACRO = re.compile(
    r"""<(?:xacro:)?macro\s[^>]{0,300}?\bname\s{0,8}=\s{0,8}["']([\w-]{1,100})["']"""
)


def macro_names(texts: Iterable[str]) -> frozenset[str]:
    """Return the names of the macros in some texts, those of URDF's own elements left out."""
    return frozenset(name for text in texts for name in _MACRO.findall(text)) - OF_URDF
