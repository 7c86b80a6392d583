"""Six-wheelers, as the content of a model: rigid, on springs, and with rockers and bogies."""

from __future__ import annotations

from tests.trial.machines import box_inertia, chassis, diff_drive, wheel

PLACES = {"f": 0.4, "m": 0.0, "r": -0.4}
SIDES = {"l": 0.3, "r": -0.3}
BODY = 30.0
"""Kilograms of the body; each arm weighs 0.5 kg and each wheel 1 kg."""


def _robot(arms: str, parents: str, lift: float = 0.0) -> str:
    """Return a robot with arms; `parents` makes a wheel's parent of its name, end and side."""
    text = ""
    for end, x in PLACES.items():
        for side, y in SIDES.items():
            parent = parents.format(name=end + side, end=end, side=side)
            level = wheel(end + side, x, y, parent=parent)
            height = 0.1 + (lift if end == "m" else 0.0)
            text += level.replace(f"<pose>{x} {y} 0.1 ", f"<pose>{x} {y} {height} ", 1)
    drive = diff_drive(("fl", "ml", "rl"), ("fr", "mr", "rr"), separation=0.6)
    return chassis(BODY, height=0.3) + arms + text + drive


def rigid(lift: float = 0.0) -> str:
    """Return a robot whose axles are fixed; the middle ones are lifted (metres)."""
    return _robot("", "base_link", lift)


def _arm(name: str, parent: str, place: str, joint: str, axis: str) -> str:
    return f"""
<link name="{name}"><pose>{place} 0 0 0</pose>
  <inertial><mass>0.5</mass>{box_inertia(0.5, 0.1, 0.05, 0.05)}</inertial></link>
<joint name="{name}_joint" type="{joint}"><parent>{parent}</parent><child>{name}</child>
  <axis>{axis}</axis></joint>"""


def _sprung(stiffness: float, damping: float, reference: float, reach: float) -> str:
    return (
        f"<limit><lower>-{reach}</lower><upper>{reach}</upper></limit><dynamics>"
        f"<damping>{damping}</damping><spring_stiffness>{stiffness}</spring_stiffness>"
        f"<spring_reference>{reference}</spring_reference></dynamics>"
    )


def on_struts(stiffness: float, damping: float, reference: float = 0.0, lift: float = 0.0) -> str:
    """Return a robot on vertical springs.

    Args:
        stiffness: N/m.
        damping: N·s/m.
        reference: Where each spring is at rest, metres; above 0, the wheel is nearer to the body.
        lift: How much higher the middle wheels are, metres.
    """
    axis = f"<xyz>0 0 1</xyz>{_sprung(stiffness, damping, reference, 0.1)}"
    arms = "".join(
        _arm(f"{end}{side}_arm", "base_link", f"{x} {y * 0.9} 0.1", "prismatic", axis)
        for end, x in PLACES.items()
        for side, y in SIDES.items()
    )
    return _robot(arms, "{name}_arm", lift)


def on_trailing_arms(stiffness: float, damping: float, reference: float = 0.0) -> str:
    """Return a robot with wheels on trailing arms of 0.15 m.

    Stiffness in N·m/rad, damping in N·m·s/rad, spring reference in rad.
    """
    axis = f"<xyz>0 1 0</xyz>{_sprung(stiffness, damping, reference, 0.6)}"
    arms = "".join(
        _arm(f"{end}{side}_arm", "base_link", f"{x + 0.15} {y * 0.9} 0.15", "revolute", axis)
        for end, x in PLACES.items()
        for side, y in SIDES.items()
    )
    return _robot(arms, "{name}_arm")


def rocker_bogie() -> str:
    """Return a robot with a rocker on each side and a bogie behind it, on stiff springs."""
    axis = f"<xyz>0 1 0</xyz>{_sprung(50.0, 0.5, 0.0, 0.5)}"
    arms = "".join(
        _arm(f"f{side}_arm", "base_link", f"0 {y * 0.8} 0.3", "revolute", axis)
        + _arm(f"b{side}_arm", f"f{side}_arm", f"-0.2 {y * 0.8} 0.2", "revolute", axis)
        for side, y in SIDES.items()
    )
    text = _robot(arms, "b{side}_arm")
    for side in SIDES:
        text = text.replace(
            f"<parent>b{side}_arm</parent><child>f{side}<",
            f"<parent>f{side}_arm</parent><child>f{side}<",
        )
    return text
