"""A model or world that is written with xacro, as xacro makes it: `world.sdf.xacro`."""

from __future__ import annotations

from checker.base.parts import NotAvailable
from checker.formats.xacro.expansion import Expander, Expansions, Unread, Wanted
from checker.formats.xacro.fault import XacroFault
from checker.launch.ros1.package_launch import SAMPLE_ARGUMENTS
from checker.package.package import Package
from checker.source.xml import XmlDocument


def expanded_model(package: Package, path: str, expander: Expander) -> XmlDocument | NotAvailable:
    """Return what xacro makes of a file with the defaults of its arguments, or why it cannot."""
    (outcome,) = Expansions(package, [Wanted(path, SAMPLE_ARGUMENTS)], expander).outcomes()
    if isinstance(outcome, XacroFault):
        return NotAvailable(f"{path} is not expanded: {outcome.message}")
    return NotAvailable(outcome.reason) if isinstance(outcome, Unread) else outcome
