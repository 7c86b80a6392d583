"""What renderers may need to know besides the report."""

from __future__ import annotations

from checker.base.record import Record
from checker.report.palette import Palette


class RenderSettings(Record):
    """How a report is to be rendered.

    Attributes:
        palette: Colours for a terminal.
        folder: Where the command was run, absolute; paths of the report start there.
        command: What was run, as a shell takes it; empty where there was no command.
    """

    palette: Palette
    folder: str
    command: str = ""
