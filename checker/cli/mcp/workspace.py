"""The folder that the server may read: paths that lead elsewhere are refused."""

from __future__ import annotations

from pathlib import Path, PurePath

from checker.base.errors import CheckerError
from checker.base.record import Record


class Workspace(Record):
    """A folder.

    Attributes:
        root: Absolute, without links.
    """

    root: Path

    @classmethod
    def at(cls, folder: Path) -> Workspace:
        """Return the workspace of a folder.

        Raises:
            CheckerError: It is no folder.
        """
        try:
            root = folder.resolve(strict=True)
        except (OSError, RuntimeError, ValueError) as error:
            reason = getattr(error, "strerror", None) or error
            raise CheckerError(f"the workspace {folder} cannot be opened: {reason}") from None
        if not root.is_dir():
            raise CheckerError(f"the workspace {folder} is not a folder")
        return cls(root)

    def path(self, text: str) -> Path:
        """Return a path relative to the root, without links.

        Args:
            text: Relative to the root, or absolute and below it.

        Raises:
            CheckerError: It leads out of the workspace, or to nothing.
        """
        if ".." in PurePath(text).parts:
            raise self._refused(text, "contains '..'")
        try:
            real = (self.root / text).resolve(strict=True)
        except FileNotFoundError:
            # What is outside is refused whether it is there or not.
            if not PurePath(text).is_absolute() or PurePath(text).is_relative_to(self.root):
                raise CheckerError(f"{text} does not exist in the workspace") from None
            raise self._refused(text, "is outside") from None
        except (OSError, RuntimeError, ValueError) as error:
            reason = getattr(error, "strerror", None) or error
            raise CheckerError(f"{text!r} cannot be opened: {reason}") from None
        if not real.is_relative_to(self.root):
            outside = PurePath(text).is_absolute() and not PurePath(text).is_relative_to(self.root)
            raise self._refused(text, "is outside" if outside else "is a link that leads outside")
        return real.relative_to(self.root)

    def _refused(self, text: str, why: str) -> CheckerError:
        return CheckerError(
            f"{text!r} {why}: only paths in the workspace {self.root} are read; give a path "
            "relative to it"
        )
