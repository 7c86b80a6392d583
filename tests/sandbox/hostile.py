"""What a process does that was taken over: started as module `hostile`, with the right of a task.

It makes all the attempts that it is asked for, in the sandbox that it finds around it.
"""

from __future__ import annotations

import json
import os
from pathlib import Path

from attempts import tried

from checker.base.sandbox.files import Files


def answer(request: bytes, _files: Files) -> bytes:
    """Make attempts.

    Args:
        request: JSON: `names` of attempts, and `assets`.

    Returns:
        JSON: what came of each, by name.
    """
    asked = json.loads(request)
    assets = asked["assets"] | {"launcher": os.getppid()}
    assets["place"] = str(Path.cwd()) if assets["works"] else assets["folder"]
    return json.dumps({name: tried(name, assets) for name in asked["names"]}).encode()
