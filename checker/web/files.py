"""The files of a result, each with a policy that lets it do nothing else."""

from __future__ import annotations

import re
from pathlib import Path

from starlette.responses import FileResponse

from checker.web.headers import POLICY

KINDS = {
    "report.json": "application/json",
    "report.sarif": "application/sarif+json",
    "report.html": "text/html; charset=utf-8",
    "index.html": "text/html; charset=utf-8",
    "robot.glb": "model/gltf-binary",
}
"""Media types by name."""
_HEAD = 4_096
"""Bytes of a page that hold its own policy."""
_SCRIPT = re.compile(rb"script-src '(sha256-[A-Za-z0-9+/]{43}=)'")
_REPORT = (
    "default-src 'none'; img-src data: blob:; style-src 'unsafe-inline'; connect-src 'none'; "
    "form-action 'none'; base-uri 'none'; frame-ancestors 'none'; "
    # In an origin of its own, it could not reach the service even if it ran what it should not.
    "sandbox allow-scripts allow-downloads allow-popups allow-popups-to-escape-sandbox; "
    "script-src "
)


def file_response(path: Path) -> FileResponse:
    """Return the answer that sends a file of a result, as what its name says."""
    kind = KINDS[path.name]
    if kind.startswith("text/html"):
        return FileResponse(path, media_type=kind, headers={POLICY: _policy(path)})
    if path.name == "robot.glb":
        return FileResponse(path, media_type=kind, filename=path.name)
    return FileResponse(path, media_type=kind)


def _policy(page: Path) -> str:
    """Return the policy of a report: its own script runs, which its head names by hash."""
    with page.open("rb") as file:
        found = _SCRIPT.search(file.read(_HEAD))
    return _REPORT + (f"'{found[1].decode('ascii')}'" if found else "'none'")
