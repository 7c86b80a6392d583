"""Native code behind the filter of calls that xacro's guard puts up, and behind nothing else.

Started as module `guarded`, without a sandbox; the guard's other measures, which hold Python, are
left out here.
"""

from __future__ import annotations

import json
import os
import resource

from attempts import tried

from checker.base.sandbox.files import Files
from checker.formats.xacro import worker


def answer(request: bytes, _files: Files) -> bytes:
    """Make attempts, as `hostile` does."""
    asked = json.loads(request)
    worker.sys.addaudithook = lambda _: None  # type: ignore[assignment]
    resource.setrlimit = lambda *_: None
    assets = asked["assets"] | {"launcher": os.getppid(), "place": asked["assets"]["folder"]}
    said = {name: tried(name, assets, worker.put_up) for name in asked["names"]}
    return json.dumps(said).encode()
