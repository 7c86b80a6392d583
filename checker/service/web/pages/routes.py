"""The pages for people: the form, a check and how far it is, and the rule book."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache, partial
from itertools import groupby
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.base.words import count, plain
from checker.package.archives.index import ArchiveLimits
from checker.package.formats import single_file_suffixes
from checker.package.inputs import ARCHIVE_SUFFIXES
from checker.rulebook.discovery import all_rules
from checker.rulebook.pages import escaped, group_description, parse_page
from checker.rulebook.profiles import profile, profile_names
from checker.rulebook.site import rule_blocks
from checker.service.jobs.port import Stage, State
from checker.service.web import receipts
from checker.service.web.answers.refusal import not_found
from checker.service.web.api.views import address_of
from checker.service.web.pages import progress
from checker.service.web.pages.progress import glance
from checker.service.web.pages.site import FOLDER, html, static_file
from checker.service.web.services import Services
from checker.service.web.uploads.transfer import new_check

if TYPE_CHECKING:
    from fastapi import APIRouter
    from markdown_it import MarkdownIt
    from markupsafe import Markup
    from starlette.requests import Request
    from starlette.responses import Response


# The rule book as the site shows it: a list by groups, and a page for each rule.


class RuleEntry(Record):
    """A rule in the list.

    Attributes:
        title: What is wrong, one line of HTML.
    """

    id: str
    name: str
    severity: str
    title: Markup


class RuleGroup(Record):
    """Rules of one group.

    Attributes:
        title: What they are about, one line of HTML.
    """

    letters: str
    title: Markup
    rules: tuple[RuleEntry, ...]


class RulePage(Record):
    """The page of a rule; `body` is HTML."""

    entry: RuleEntry
    body: Markup


@cache
def rule_groups() -> tuple[RuleGroup, ...]:
    """Return all rules by group."""
    groups = []
    for letters, members in groupby(all_rules(), lambda rule: rule.group):
        rules = list(members)
        entries = tuple(rule_pages()[rule.id].entry for rule in rules)
        groups.append(RuleGroup(letters, _line(group_description(rules)), entries))
    return tuple(groups)


@cache
def rule_pages() -> Mapping[str, RulePage]:
    """Return the page of each rule by its id."""
    from markupsafe import Markup

    pages = {}
    for rule in all_rules():
        title = _line(escaped(parse_page(rule.page).title))
        entry = RuleEntry(rule.id, rule.name, str(rule.severity), title)
        # Markdown without HTML in it: what is rendered is safe for any rule.
        body = Markup(_markdown().render("\n\n".join(rule_blocks(rule))))  # noqa: S704
        pages[rule.id] = RulePage(entry, body)
    return pages


def _line(markdown: str) -> Markup:
    from markupsafe import Markup

    return Markup(_markdown().renderInline(markdown))  # noqa: S704


@cache
def _markdown() -> MarkdownIt:
    from markdown_it import MarkdownIt

    return MarkdownIt("commonmark", {"html": False}).enable("table")


_PACKAGES_SHOWN = 500
_FILES = {
    "report.json": ("JSON", "what subt-check --format json writes"),
    "report.sarif": ("SARIF", "for code scanning"),
    "robot.glb": ("robot.glb", "the robot and its trial for Blender and other viewers"),
}
"""Files of a result that the page offers besides the report, with their names and uses."""


def router(services: Services) -> APIRouter:
    """Return the routes of the pages.

    Args:
        services: What they show.
    """
    from fastapi import APIRouter

    pages = _Pages(services)
    site = APIRouter()
    add = partial(site.add_route, include_in_schema=False)
    add("/", pages.start, methods=["GET"])
    add("/checks", pages.send, methods=["POST"])
    add("/checks/{id}", pages.check, methods=["GET"])
    add("/checks/{id}/cancel", pages.cancel, methods=["POST"])
    add("/checks/{id}/delete", pages.ask_to_delete, methods=["GET"])
    add("/checks/{id}/delete", pages.delete, methods=["POST"])
    add("/api", pages.api, methods=["GET"])
    add("/rules", _rules, methods=["GET"])
    add("/rules/{id}", _rule, methods=["GET"])
    add(FOLDER + "/{release}/{name}", _static, methods=["GET"])
    return site


class _Pages(Record):
    """The pages that need the objects of the service.

    What is no coroutine runs in a thread: the engine and the disk may take their time.
    """

    services: Services

    def start(self, request: Request) -> Response:
        """Show the form, and the result of what is sent."""
        config, limits = self.services.config, ArchiveLimits()
        return html(
            "start.html.j2",
            here="start",
            upload_limit=config.upload_limit,
            size=_megabytes(config.upload_limit),
            unpacked=_megabytes(limits.unpacked_bytes),
            limits=limits,
            endings=(*ARCHIVE_SUFFIXES, *single_file_suffixes()),
            archives=ARCHIVE_SUFFIXES,
            single_files=single_file_suffixes(),
            profiles=[profile(name) for name in profile_names()],
            needs_token=bool(config.tokens),
            kept=count(config.retention_days, "day"),
            address=self.services.address(request),
        )

    async def send(self, request: Request) -> Response:
        """Take the form as a browser without scripts sends it, and go to its check."""
        receipt = await new_check(request, self.services)
        answer = _see_other(f"/checks/{receipt.id}")
        receipts.give(answer, receipt, request, self.services)
        return answer

    def check(self, request: Request) -> Response:
        """Show a check: its steps, the first findings, in the end its results."""
        state = self.services.check(request.path_params["id"])
        first = glance(self.services.store, state.result)
        names = self.services.store.names(state.result) if state.result else ()
        done = state.stage is Stage.DONE
        packages = progress.package_lines(state, names if done else ())
        ended_early = state.stage.is_final and not done
        events = self.services.jobs.events({state.id: 0}) if ended_early else {}
        return html(
            "check.html.j2",
            id=state.id,
            name=progress.title(state, packages),
            file=plain(state.order.name),
            final=state.stage.is_final,
            mine=bool(receipts.stored_secret(request)),
            headline=progress.headline(state, packages),
            steps=progress.steps_of(state, events.get(state.id, ())),
            packages=packages,
            main=progress.main_package(packages),
            shown=_PACKAGES_SHOWN,
            files=_files(state, names) if done else (),
            first=first,
            link=f"{self.services.address(request)}/checks/{state.id}",
            events=f"/api/checks/{state.id}/events",
            expires=progress.moment(state.expires) if state.expires else None,
        )

    def cancel(self, request: Request) -> Response:
        """End a check and go back to its page."""
        id = request.path_params["id"]
        receipts.cancel(self.services, id, receipts.stored_secret(request))
        return _see_other(f"/checks/{id}")

    def ask_to_delete(self, request: Request) -> Response:
        """Ask whether a check is really to be deleted."""
        state = self.services.check(request.path_params["id"])
        if not receipts.stored_secret(request):
            raise receipts.not_yours("delete its check")
        packages = progress.package_lines(state, ())
        name = progress.title(state, packages)
        return html("delete.html.j2", id=state.id, name=name, deleted=False)

    def delete(self, request: Request) -> Response:
        """Delete a check, and state it: its own page is gone."""
        state = self.services.check(request.path_params["id"])
        receipts.delete(self.services, state.id, receipts.stored_secret(request))
        name = progress.title(state, progress.package_lines(state, ()))
        answer = html("delete.html.j2", name=name, deleted=True)
        receipts.take(answer, state.id)
        return answer

    def api(self, _: Request) -> Response:
        """Return where the API is described."""
        return html("api.html.j2", here="api", needs_token=bool(self.services.config.tokens))


def _rules(_: Request) -> Response:
    groups = rule_groups()
    number = sum(len(group.rules) for group in groups)
    return html("rules.html.j2", here="rules", groups=groups, number=number)


def _rule(request: Request) -> Response:
    page = rule_pages().get(request.path_params["id"].upper())
    if page is None:
        raise not_found()
    return html("rule.html.j2", entry=page.entry, body=page.body)


def _static(request: Request) -> Response:
    file = static_file(request.path_params["release"], request.path_params["name"])
    if file is None:
        raise not_found()
    return file


def _files(state: State, names: tuple[str, ...]) -> list[tuple[str, str, str]]:
    """Return label, address and use of each file that is offered."""
    return [
        (label, address_of(state.id, name), use)
        for name, (label, use) in _FILES.items()
        if name in names
    ]


def _megabytes(size: int) -> str:
    return f"{size / 1e6:g} MB"


def _see_other(address: str) -> Response:
    from starlette.responses import RedirectResponse

    return RedirectResponse(address, status_code=303)
