"""Arguments that several commands have, and the types of arguments."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from pathlib import Path
from typing import Any

PROFILES = (
    *("subt", "sdf", "urdf", "gazebo-harmonic", "gazebo-fortress", "gazebo-ionic", "gazebo-jetty"),
    *("ros2", "ros2-classic", "gazebo-classic", "mujoco"),
)
DISTROS = ("humble", "iron", "jazzy", "kilted", "lyrical", "rolling")
FORMAT_NAMES = ("text", "concise", "json", "sarif", "github", "junit", "markdown", "html")

EXITS = """exit codes:
  0    nothing at or above --fail-on
  1    findings at or above --fail-on
  2    wrong usage, input that cannot be read, or a request that cannot be met
  3    a bug in subt-check, or a service or database that does not answer
  130  interrupted (Ctrl-C)
"""


def add_exit_codes(parser: argparse.ArgumentParser) -> None:
    """State below the help of a command what its exit codes mean."""
    parser.epilog = EXITS
    parser.formatter_class = argparse.RawDescriptionHelpFormatter


def add_report_options(parser: argparse.ArgumentParser) -> None:
    """Add what to check for, and where and how the result is reported."""
    parser.add_argument(
        "--output-format",
        "--format",
        dest="format",
        choices=FORMAT_NAMES,
        default="text",
        help="format of the result (default: text); concise: one line per finding",
    )
    parser.add_argument(
        "--output", metavar="FILE", help="write the result to this file instead of stdout"
    )
    parser.add_argument(
        "--report",
        metavar="DIR",
        help="also write report.html, report.json, report.sarif and robot.glb into this folder",
    )
    parser.add_argument(
        "--color",
        choices=("auto", "always", "never"),
        default="auto",
        help="when to print in colour (default: auto)",
    )
    add_profile(parser)
    parser.add_argument(
        "--fail-on",
        choices=("error", "warning"),
        help="lowest severity that fails (default: error)",
    )


def add_profile(parser: argparse.ArgumentParser) -> None:
    """Add the target to check for."""
    parser.add_argument(
        "--profile",
        choices=PROFILES,
        help="target, with its set of rules (default: detected from the package)",
    )


def add_distro(parser: argparse.ArgumentParser) -> None:
    """Add the distribution of a ROS 2 target."""
    parser.add_argument(
        "--distro", choices=DISTROS, help="ROS 2 distribution to check for (default: jazzy)"
    )


def add_search_options(parser: argparse.ArgumentParser) -> None:
    """Add where further packages are, and the arguments of xacro files."""
    parser.add_argument(
        "--package-path",
        metavar="DIR",
        action="append",
        type=Path,
        help="also use the packages of this folder, or this package; may be repeated",
    )
    parser.add_argument(
        "--xacro-arg",
        metavar="NAME:=VALUE",
        action="append",
        type=argument,
        help="argument for xacro files; may be repeated",
    )


def search_wishes(options: argparse.Namespace) -> Mapping[str, Any]:
    """Return these options as fields of `Settings`; None leaves one to the settings files."""
    return {
        "package_path": tuple(options.package_path) if options.package_path else None,
        "xacro_args": dict(options.xacro_arg) if options.xacro_arg else None,
    }


def add_data(parser: argparse.ArgumentParser) -> None:
    """Add the folder of a service, and what several machines share."""
    parser.add_argument(
        "--data",
        metavar="DIR",
        default="",
        help=(
            "folder for uploads and reports (default: SUBT_CHECK_DATA, else the user's data folder)"
        ),
    )
    parser.add_argument(
        "--store",
        metavar="URL",
        default="",
        help=(
            "bucket for uploads and reports of several machines, such as s3://bucket/prefix; "
            "DIR then holds copies (default: SUBT_CHECK_STORE, else none)"
        ),
    )


def argument(text: str) -> tuple[str, str]:
    """Return an argument of xacro, written `name:=value`."""
    name, assigned, value = text.partition(":=")
    if not name.strip() or not assigned:
        raise argparse.ArgumentTypeError(f"{text!r} is not an argument, expected name:=value")
    return name.strip(), value


def above_zero(text: str) -> float:
    """Return a number above 0."""
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0.0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"{text!r} is not a limit, expected a number above 0")
    return value


def ids(text: str) -> tuple[str, ...]:
    """Return words with commas between."""
    return tuple(word.strip() for word in text.split(",") if word.strip())


def positive(text: str) -> int:
    """Return a number of processes, 1 or more."""
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(
            f"{text!r} is not a number of processes, expected 1 or more"
        )
    return int(text)


def count(text: str) -> int:
    """Return a number of processes, 0 or more."""
    if not text.isdecimal():
        raise argparse.ArgumentTypeError(
            f"{text!r} is not a number of processes, expected 0 or more"
        )
    return int(text)


def networks(text: str) -> str:
    """Return addresses and networks as they are: one that is misspelt would never be met."""
    import ipaddress

    for network in text.split(",") if text else ():
        try:
            ipaddress.ip_network(network.strip())
        except ValueError:
            raise argparse.ArgumentTypeError(
                f"{network!r} is not an address or network, expected for example 127.0.0.1 or "
                "172.30.77.0/24"
            ) from None
    return text


def port(text: str) -> int:
    """Return a port."""
    if not (text.isascii() and text.isdecimal()) or int(text) > 65535:
        raise argparse.ArgumentTypeError(f"{text!r} is not a port, expected a number up to 65535")
    return int(text)
