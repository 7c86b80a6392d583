"""Text between the elements of a model of MuJoCo.

MJCF has no text: MuJoCo ignores it without a message. It is what an edit left over, often the end
of a comment, so that an element is read that was to be left out, or the other way round.

Fix: delete the text.
Source: MuJoCo 4.0.0, tried.
"""

from checker.formats.mjcf.model import MjcfModel
from checker.rule import Concern, Findings, Safety, Severity, finding, replace_text, rule


@rule("MJC003", "text-between-elements", Severity.WARNING, Concern.ROBOT)
def check(model: MjcfModel) -> Findings:
    """Report text in elements of a model and of what it includes."""
    for element in model.elements:
        for text in element.stray_texts:
            yield finding(
                text,
                f"text {text.text[:40]!r} in <{element.tag}> is ignored by MuJoCo: delete it",
                fix=replace_text(text, "", Safety.SAFE),
            )


_BODY = "<worldbody>\n<body><joint/><geom size='1'/></body>{}\n</worldbody>"
GOOD = [{"@mjcf": _BODY.format("<!-- a note -->")}]
BAD = [{"@mjcf": _BODY.format("> <!-- ^ MJC003 -->")}]
