"""Takes from Python what Windows does not have; on the search path of a process, it runs first.

Modules of the standard library that use it are loaded before, as they have other ways on Windows.
"""

from __future__ import annotations

import multiprocessing.resource_tracker
import os
import random
import select
import selectors
import signal
import socket
import subprocess
import sys
import tempfile

_LOADED = (multiprocessing.resource_tracker, random, selectors, subprocess, tempfile)
multiprocessing.set_start_method("spawn")
MODULES = ("fcntl", "grp", "pty", "pwd", "resource", "termios", "tty")
ATTRIBUTES = {
    os: (
        "O_CLOEXEC", "O_DIRECTORY", "O_NOFOLLOW", "O_NONBLOCK", "O_PATH", "chown", "chroot",
        "fork", "geteuid", "getgid", "getgroups", "getloadavg", "getpgid", "getpriority",
        "killpg", "memfd_create", "mkfifo", "nice", "posix_fallocate", "pread", "pwrite",
        "register_at_fork", "sched_getaffinity", "setgid", "setgroups", "setpgid", "setpriority",
        "setresgid", "setresuid", "setsid", "setuid", "sysconf", "wait3", "wait4",
        "waitid",
    ),
    select: ("epoll", "poll"),
    signal: (
        "ITIMER_PROF", "ITIMER_REAL", "SIGALRM", "SIGCHLD", "SIGHUP", "SIGPIPE",
        "SIGPROF", "SIGQUIT", "SIGUSR1", "SIGUSR2", "SIGXCPU", "SIGXFSZ", "alarm",
        "setitimer", "siginterrupt", "sigwait",
    ),
    socket: ("recv_fds", "send_fds"),
}  # fmt: skip

for name in MODULES:
    sys.modules[name] = None  # type: ignore[assignment] # its import fails
for module, names in ATTRIBUTES.items():
    for name in names:
        if hasattr(module, name):
            delattr(module, name)
