"""The process that `checker.base.sandbox.plain_launcher` starts: it does one task and ends.

The request is the file of its standard input, the answer that of its standard output.
"""

from __future__ import annotations

import json
import os
import sys

from checker.base.sandbox.task import do


def main(order: str) -> int:
    """Do what was ordered; return the exit code."""
    if sys.platform == "win32":
        import msvcrt

        for descriptor in (0, 1):
            msvcrt.setmode(descriptor, os.O_BINARY)
    request, answer = os.dup(0), os.dup(1)
    nowhere = os.open(os.devnull, os.O_RDWR)
    for stream in (0, 1):
        os.dup2(nowhere, stream)
    return do(json.loads(order), request, answer)


if __name__ == "__main__":
    os._exit(main(sys.argv[1]))
