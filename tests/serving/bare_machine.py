"""`subt-check` where no layer hides files: `python tests/serving/bare_machine.py serve`.

There is no bubblewrap, and the kernel refuses namespaces, Landlock and other users.
"""

from __future__ import annotations

import os
import platform
import sys

from checker import cli
from checker.base.sandbox import seccomp
from checker.base.sandbox.seccomp import architecture

_CREATE_RULESET = 444
_SETGROUPS = {"x86_64": 116, "aarch64": 159}


def tear_down() -> None:
    """Have the kernel refuse, to this process and all that it starts, what sandbox are made of."""
    machine = architecture()
    assert machine is not None
    steps = [(seccomp._LOAD, 0, 0, seccomp._NUMBER)]
    for number in (
        machine.calls["unshare"],
        _CREATE_RULESET,
        _SETGROUPS[platform.machine()],
    ):
        refuse = (seccomp._RETURN, 0, 0, seccomp._ERROR | seccomp._EPERM)
        steps += [(seccomp._EQUAL, 0, 1, number or 0), refuse]
    allow = (seccomp._RETURN, 0, 0, seccomp._ALLOW)
    seccomp.gain_nothing()
    seccomp._install(b"".join(seccomp._packed([*steps, allow])))
    os.environ["PATH"] = os.devnull


if __name__ == "__main__":
    tear_down()
    sys.exit(cli.main())
