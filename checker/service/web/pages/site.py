"""The site's templates, and its fixed files under addresses that change with them."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from functools import cache
from typing import TYPE_CHECKING, Any

from checker.base.resources import templates, version_of
from checker.report.html.page import environment, text_of

if TYPE_CHECKING:
    from jinja2 import Environment
    from starlette.responses import Response

FOLDER = "/static"
KINDS = {".css": "text/css", ".js": "text/javascript", ".svg": "image/svg+xml"}
"""Media types by suffix; all of them are text of ours."""
OF_THE_SITE = (
    *("site.css", "icon.svg"),
    *("upload.js", "choosing.js", "parts.js", "zip.js", "sending.js", "watch.js"),
)
OF_THE_REPORT = ("report.css",)
"""Files that the site shares with the reports, so that both look the same."""
FOR_EVER = "public, max-age=31536000, immutable"


@cache
def files() -> Mapping[str, str]:
    """Return the fixed files by name."""
    return {name: text_of(name) for name in OF_THE_REPORT} | {
        name: _text(name) for name in OF_THE_SITE
    }


@cache
def release() -> str:
    """Return a word that changes when any of the fixed files does.

    It is a folder of their addresses, so that modules find each other by relative names.
    """
    digest = hashlib.sha256()
    for name, text in sorted(files().items()):
        digest.update(f"{name}\n{len(text)}\n{text}".encode())
    return digest.hexdigest()[:16]


def static_file(of_release: str, name: str) -> Response | None:
    """Return a fixed file, or None for what is not one of this release."""
    from starlette.responses import Response

    if of_release != release() or name not in files():
        return None
    kind = KINDS[name[name.rindex(".") :]]
    return Response(files()[name], media_type=kind, headers={"Cache-Control": FOR_EVER})


def html(template: str, *, status: int = 200, here: str = "", **values: Any) -> Response:
    """Return a page of the site.

    Args:
        template: Its file in `templates/web`.
        status: The status of the answer.
        here: The link on top that leads to this page; empty for none.
        values: What the template shows; every text is escaped.
    """
    from starlette.responses import HTMLResponse

    page = _templates().get_template(template)
    frame = {"static": f"{FOLDER}/{release()}", "version": version_of("subt-check")}
    return HTMLResponse(page.render(status=status, here=here, **frame, **values), status)


@cache
def _templates() -> Environment:
    """Return what renders the site: as the reports are rendered, from another folder."""
    from jinja2 import FunctionLoader

    return environment().overlay(loader=FunctionLoader(_text))


def _text(name: str) -> str:
    return templates("web").joinpath(name).read_text("utf-8")
