"""`subt-check completion`: prints the completion script for a shell."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Mapping

from checker.base.output import EXIT_CLEAN, show
from checker.rulebook.discovery import all_rules

SHELLS = ("bash", "zsh", "fish")
_FOLDERS = ("DEST", "DIR", "FOLDER")
_FILES = ("FILE", "PACKAGE", "PATH", "SOURCE")
"""Names of arguments that are files."""
_SHORT_FORM = {
    "bash": [("complete -o bashdefault ", "complete -o bashdefault -o default ")],
    "zsh": [
        ("': :_shtab_subt_check_commands'", "': :{_shtab_subt_check_commands; _files}'"),
        (
            "esac\n  esac",
            "  *) _arguments -C -s $_shtab_subt_check_check_options ;;\n      esac\n  esac",
        ),
    ],
    "fish": [
        (
            "complete -c subt-check -f\n",
            "complete -c subt-check -f\ncomplete -c subt-check -n _shtab_subt_check_using -F\n",
        )
    ],
}
"""Changes to a completion script: `subt-check PATH` is short for `subt-check check PATH`, so a word
that is no command may be a file."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what the command takes."""
    parser.description = (
        "Print a script; put it into ~/.local/share/bash-completion/completions/subt-check for "
        "bash, into _subt-check in a folder of $fpath for zsh, and into "
        "~/.config/fish/completions/subt-check.fish for fish."
    )
    parser.add_argument("shell", choices=SHELLS)


def run(options: argparse.Namespace) -> int:
    """Print the script."""
    show(script(options.shell))
    return EXIT_CLEAN


def script(shell: str) -> str:
    """Return the script for a shell; it names the rules that there are now."""
    import shtab

    from checker.cli import build_parser

    parser = build_parser()
    _take_options(parser)
    for action in _actions(parser):
        _describe(action, {"file": shtab.FILE, "folder": shtab.DIRECTORY})
    text: str = shtab.complete(parser, shell)
    for shown, wanted in _SHORT_FORM[shell]:
        text = text.replace(shown, wanted)
    return f"{text}\n"


def _take_options(parser: argparse.ArgumentParser) -> None:
    """Let the program itself take the options of `check`, as `subt-check PATH` does."""
    from checker.cli.check.command import add_arguments as add_those_of_check

    short = argparse.ArgumentParser(add_help=False)
    add_those_of_check(short)
    for action in short._actions:
        if action.option_strings:
            parser._add_action(action)


def _actions(parser: argparse.ArgumentParser) -> Iterator[argparse.Action]:
    """Yield all arguments of a command and of those below it."""
    for action in parser._actions:  # argparse names no other way
        yield action
        if isinstance(action, argparse._SubParsersAction):
            for command in action.choices.values():
                yield from _actions(command)


def _describe(action: argparse.Action, places: Mapping[str, object]) -> None:
    """Report what an argument takes, for completion alone."""
    rules = all_rules()
    if action.dest == "id":
        action.choices = [name for rule in rules for name in (rule.id, rule.name)]
    elif action.metavar == "IDS":
        # Without concerns: zsh takes a colon for the end of the list.
        names = {name for rule in rules for name in (rule.id, rule.name, rule.group)}
        action.choices = sorted(names)
    elif action.metavar in (*_FILES, *_FOLDERS):
        kind = "folder" if action.metavar in _FOLDERS else "file"
        action.complete = places[kind]  # type: ignore[attr-defined]  # what shtab reads
