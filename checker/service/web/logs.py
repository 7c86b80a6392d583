"""Logs: one JSON object a line on stderr, without tokens and without ids that open a report."""

from __future__ import annotations

import hashlib
import json
import logging
import sys
from datetime import UTC, datetime

LOGGER = "subt-check.web"
FIELDS = "fields"
"""Name of the extra of a record that holds what goes into the line beside its message."""
_OF_THE_SERVER = ("uvicorn", "uvicorn.error")
_WITH_ADDRESSES = "uvicorn.access"


class JsonLines(logging.Formatter):
    """A record as one line of ASCII: no text in it can begin a line of its own."""

    def format(self, record: logging.LogRecord) -> str:
        """Return the line."""
        line: dict[str, object] = {
            "time": datetime.fromtimestamp(record.created, UTC).isoformat(timespec="milliseconds"),
            "level": record.levelname.lower(),
            "logger": record.name,
            "message": record.getMessage(),
        }
        line |= getattr(record, FIELDS, {})
        if record.exc_info:
            line["trace"] = self.formatException(record.exc_info)
        return json.dumps(line, default=str)


def log_to_stderr() -> None:
    """Have this process log to stderr; the server's own log of addresses, which hold ids, ends."""
    handler = logging.StreamHandler(sys.stderr)
    handler.setFormatter(JsonLines())
    logging.basicConfig(level=logging.WARNING, handlers=[handler])
    for name in (LOGGER.partition(".")[0], *_OF_THE_SERVER):
        logger = logging.getLogger(name)
        logger.handlers = [] if name == "uvicorn.error" else [handler]
        logger.propagate = name == "uvicorn.error"
        logger.setLevel(logging.INFO)
    of_addresses = logging.getLogger(_WITH_ADDRESSES)
    of_addresses.handlers, of_addresses.propagate = [], False


def short(id: str) -> str:
    """Return what tells checks apart in logs and opens none of them."""
    return hashlib.sha256(id.encode("utf-8", "replace")).hexdigest()[:12]
