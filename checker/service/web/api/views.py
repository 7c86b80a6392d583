"""What the API tells of a check."""

from __future__ import annotations

from collections.abc import Iterable
from urllib.parse import quote

from pydantic import BaseModel, Field

from checker.base.words import plain
from checker.service.jobs.port import Stage, State


class Created(BaseModel):
    """A check that was created."""

    id: str = Field(description="Id of the check; everybody who knows it can see the report.")
    url: str = Field(description="Page for people.")


class PackageView(BaseModel):
    """The current result of a package."""

    name: str
    verdict: str = Field(description="ready, not_ready or incomplete.")
    errors: int
    warnings: int
    infos: int
    folder: str = Field(description="Folder of its files; empty if there is only one package.")


class CheckView(BaseModel):
    """The current state of a check."""

    id: str
    url: str = Field(description="Page for people.")
    name: str = Field(description="Name of the uploaded file, made safe.")
    profile: str = Field(description="Empty: chosen for the package.")
    stage: Stage
    final: bool = Field(description="Whether the check has ended.")
    words: str = Field(description="Current step, or the error.")
    ahead: int = Field(description="Number of checks before it in the queue.")
    created: float = Field(description="Seconds since the epoch.")
    expires: float = Field(description="When all its data is deleted; seconds since the epoch.")
    packages: list[PackageView]
    files: list[str] = Field(description="Addresses of the files that are ready.")


def check_view(state: State, url: str, names: Iterable[str]) -> CheckView:
    """Return what the API tells.

    Args:
        state: Of the check.
        url: Of its page.
        names: Of the files of its result.
    """
    return CheckView(
        id=state.id,
        url=url,
        name=plain(state.order.name),
        profile=state.order.profile,
        stage=state.stage,
        final=state.stage.is_final,
        words=plain(state.words),
        ahead=state.ahead,
        created=state.created,
        expires=state.expires,
        packages=[
            PackageView(
                name=plain(str(each["name"])),
                verdict=str(each["verdict"]),
                errors=int(each["errors"]),
                warnings=int(each["warnings"]),
                infos=int(each["infos"]),
                folder=str(each["folder"]),
            )
            for each in state.packages
        ],
        files=[address_of(state.id, name) for name in names],
    )


def address_of(id: str, name: str) -> str:
    """Return the path under which a file of a result is fetched."""
    folder, slash, file = name.rpartition("/")
    inner = "packages/" if folder or file == "index.html" else ""
    return f"/api/checks/{id}/{inner}{quote(folder, safe='')}{slash}{quote(file)}"
