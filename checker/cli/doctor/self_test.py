"""Checks and drives a robot that is known to be ready, and makes the page of its report."""

from __future__ import annotations

import re
from pathlib import Path
from time import perf_counter

from checker.base.extras import PHYSICS
from checker.base.resources import project_folder
from checker.base.words import plain, shortened
from checker.cli.doctor.installation import INSTALL_AGAIN, Result, State
from checker.pipeline import check_package
from checker.report.formats import FORMATS
from checker.report.render_settings import Palette, RenderSettings
from checker.report.report import PackageReport, VerdictKind
from checker.settings import Settings

SAMPLE = "husky_migration_sensor_config_1"
_IMPORT_ERROR = re.compile(r"\((?:ImportError|ModuleNotFoundError): ")
_REPORT_IT = "please report this with the output of the command"


def self_test() -> Result:
    """Check a sample as a user's package is checked, with nothing remembered."""
    started = perf_counter()
    try:
        report = check_package(sample(), Settings(cache=False))
        (package,) = report.packages
        FORMATS["html"](report, RenderSettings(Palette(enabled=False), str(sample())))
    except ImportError as error:
        return Result(State.PROBLEM, f"the self-test fails: {plain(str(error))}", INSTALL_AGAIN)
    except Exception as error:  # noqa: BLE001 - whatever it is, it is what was looked for
        reason = plain(shortened(f"{type(error).__name__}: {error}", 300))
        return Result(State.PROBLEM, f"the self-test fails: {reason}", _REPORT_IT)
    trouble = _trouble(package)
    if trouble:
        advice = INSTALL_AGAIN if _IMPORT_ERROR.search(trouble) else _REPORT_IT
        return Result(State.PROBLEM, f"the self-test fails: {trouble}", advice)
    done = "checked, weighed and driven" if PHYSICS.is_installed else "checked"
    took = f"{perf_counter() - started:.1f} s"
    return Result(State.OK, f"self-test: a sample robot is {done} in {took}")


def sample() -> Path:
    """Return the folder of the sample."""
    return project_folder("samples") / SAMPLE


def _trouble(report: PackageReport) -> str:
    """Return what is not as it is known to be; empty if all is well."""
    if report.blind_spots:
        first = report.blind_spots[0]
        reason = first.reason.partition("; please report")[0]
        return plain(shortened(f"{first.rule} does not run: {reason}", 300))
    if report.verdict is not VerdictKind.READY:
        return f"{report.findings[0].rule} is reported for a robot without errors"
    return "" if report.trial or not PHYSICS.is_installed else "the robot is not driven"
