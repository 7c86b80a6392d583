"""URDF, also as xacro makes it."""

from checker.package.formats import Format

FORMAT = Format("urdf", (".urdf", ".xacro"), ("robot",), is_grouped=True)
