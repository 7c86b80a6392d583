"""Limits of a process on Windows: a job object (learn.microsoft.com: Job Objects)."""

from __future__ import annotations

import sys

_EXTENDED_LIMITS = 9
"""JobObjectExtendedLimitInformation."""
_PROCESS_TIME, _PROCESS_MEMORY, _SILENT_CRASH = 0x2, 0x100, 0x400
"""JOB_OBJECT_LIMIT_PROCESS_TIME, _PROCESS_MEMORY and _DIE_ON_UNHANDLED_EXCEPTION."""
_TICKS = 10_000_000
"""In a second, of 100 ns."""
OUT_OF_TIME = 1816
"""Exit code of a process that has used its time: ERROR_NOT_ENOUGH_QUOTA."""


def limit_by_job(seconds: int, memory: int) -> None:
    """Put this process into a job with limits; one that is in a job already gets a nested one.

    Args:
        seconds: Seconds of processor time, after which it ends with `OUT_OF_TIME`.
        memory: Bytes that it may commit.

    Raises:
        OSError: The system refuses it.
    """
    if sys.platform != "win32":
        raise OSError("only Windows has job objects")
    import ctypes
    from ctypes import wintypes

    class Basic(ctypes.Structure):
        _fields_ = (
            ("process_time", wintypes.LARGE_INTEGER),
            ("job_time", wintypes.LARGE_INTEGER),
            ("flags", wintypes.DWORD),
            ("least_working_set", ctypes.c_size_t),
            ("most_working_set", ctypes.c_size_t),
            ("processes", wintypes.DWORD),
            ("affinity", ctypes.c_size_t),
            ("priority", wintypes.DWORD),
            ("scheduling", wintypes.DWORD),
        )

    class Extended(ctypes.Structure):
        _fields_ = (
            ("basic", Basic),
            ("input_and_output", ctypes.c_ulonglong * 6),
            ("process_memory", ctypes.c_size_t),
            ("job_memory", ctypes.c_size_t),
            ("most_process_memory", ctypes.c_size_t),
            ("most_job_memory", ctypes.c_size_t),
        )

    kernel = ctypes.WinDLL("kernel32", use_last_error=True)
    kernel.CreateJobObjectW.restype = wintypes.HANDLE
    kernel.GetCurrentProcess.restype = wintypes.HANDLE
    limits = Extended()
    limits.basic.process_time = max(seconds, 1) * _TICKS
    limits.basic.flags = _PROCESS_TIME | _PROCESS_MEMORY | _SILENT_CRASH
    limits.process_memory = memory
    job = wintypes.HANDLE(kernel.CreateJobObjectW(None, None))
    held = kernel.SetInformationJobObject(
        job, _EXTENDED_LIMITS, ctypes.byref(limits), ctypes.sizeof(limits)
    ) and kernel.AssignProcessToJobObject(job, wintypes.HANDLE(kernel.GetCurrentProcess()))
    if not held:
        raise ctypes.WinError(ctypes.get_last_error())
