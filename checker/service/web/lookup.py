"""Checks by the ids that clients send."""

from __future__ import annotations

import re

from checker.service.jobs.port import State
from checker.service.web.refusal import not_found
from checker.service.web.services import Services

_ID = re.compile(r"[A-Za-z0-9_-]{1,64}")
"""What can be an id at all; the rest is not asked of the database."""


def check_of(services: Services, id: str) -> State:
    """Return where a check stands.

    Raises:
        Refused: There is none; the answer is one and the same for all ids.
        JobsUnreachable: The database does not answer.
    """
    state = services.jobs.status(id) if _ID.fullmatch(id) else None
    if state is None:
        raise not_found()
    return state
