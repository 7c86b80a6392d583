"""What the API tells of a check."""

from __future__ import annotations

from collections.abc import Iterable
from urllib.parse import quote

from pydantic import BaseModel, Field

from checker.base.words import plain
from checker.service.jobs.port import Stage, State


class Created(BaseModel):
    """A check that was ordered."""

    id: str = Field(description="Of the check; who has it can see the report.")
    url: str = Field(description="Its page for people.")


class PackageView(BaseModel):
    """What is known of a package so far."""

    name: str
    verdict: str = Field(description="ready, not_ready or incomplete.")
    errors: int
    warnings: int
    infos: int
    folder: str = Field(description="Of its files; empty where there is one package only.")


class CheckView(BaseModel):
    """Where a check stands."""

    id: str
    url: str = Field(description="Its page for people.")
    name: str = Field(description="Of the uploaded file, made safe.")
    profile: str = Field(description="Empty for what suits the package.")
    stage: Stage
    final: bool = Field(description="Whether nothing will change any more.")
    words: str = Field(description="What is going on, or went wrong.")
    ahead: int = Field(description="Checks in front of it in the queue.")
    created: float = Field(description="Seconds since the epoch.")
    expires: float = Field(description="When everything of it is deleted; seconds since the epoch.")
    packages: list[PackageView]
    files: list[str] = Field(description="Addresses of what there is to fetch so far.")


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
