"""The application of a web server, made as the environment says."""

from __future__ import annotations

from typing import TYPE_CHECKING

from checker.service.jobs.durable.client import durable_jobs
from checker.service.jobs.place import database_url
from checker.service.store.place import data_folder
from checker.service.store.store import Store
from checker.service.web.app import create_app
from checker.service.web.clerk.port import Clerk
from checker.service.web.config import config_from
from checker.service.web.logs import log_to_stderr

if TYPE_CHECKING:
    from fastapi import FastAPI


def app_from_environment(clerk: Clerk | None = None) -> FastAPI:
    """Return the application as the environment wants it.

    Args:
        clerk: Takes uploads that have come whole; None for one within this process.

    Raises:
        CheckerError: A variable has a value that makes no sense, or there is no place for data.
    """
    config = config_from()
    log_to_stderr()
    store = Store(data_folder())
    store.folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    store.sweep()
    jobs = durable_jobs(database_url(), store, config.retention_days)
    app = create_app(jobs, store, config, clerk)
    # The framework works its routes out when they are first needed, which takes as long as several
    # uploads: now nobody waits for it.
    app.openapi()
    return app
