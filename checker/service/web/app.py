"""The web application: routes, and what stands around all of them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from checker.base.resources import version_of
from checker.service.jobs.port import Jobs
from checker.service.store.store import Store
from checker.service.web import api, health, pages
from checker.service.web.answers import say_no_by
from checker.service.web.clerk.port import Clerk
from checker.service.web.clerk.threads import ThreadClerk
from checker.service.web.config import Config
from checker.service.web.courtesy import Courtesy
from checker.service.web.gate import Gate
from checker.service.web.headers import SecurityHeaders
from checker.service.web.metrics import Metrics
from checker.service.web.observing import Observing
from checker.service.web.origin import OwnOrigin
from checker.service.web.services import Services

if TYPE_CHECKING:
    from fastapi import FastAPI
    from fastapi.telemetry import TelemetryConfig

_NO_TELEMETRY: TelemetryConfig = {
    "tracing": False,
    "metrics": False,
    "logs": False,
    "operation_spans": False,
    "auto_configure": False,
}
"""The framework's own would send addresses, which hold ids, to whom the environment names."""


def create_app(jobs: Jobs, store: Store, config: Config, clerk: Clerk | None = None) -> FastAPI:
    """Return the application.

    Args:
        jobs: The engine that checks.
        store: Uploads and results.
        config: What is allowed.
        clerk: Takes uploads that have come whole; None for one within this process.
    """
    from fastapi import FastAPI

    metrics = Metrics()
    clerk = clerk or ThreadClerk(store, jobs)
    services = Services(jobs, store, clerk, config, Gate(config), metrics)
    app = FastAPI(
        title="subt-check",
        version=version_of("subt-check"),
        description="Checks robot model packages: upload one, follow the check, fetch the report.",
        openapi_url="/api/openapi.json",
        docs_url=None,  # its page would load scripts from elsewhere
        redoc_url=None,
        redirect_slashes=False,
        telemetry=_NO_TELEMETRY,
    )
    say_no_by(app)
    app.include_router(api.router(services))
    app.include_router(health.router(services))
    app.include_router(pages.router(services))
    # The last added stands outermost.
    app.add_middleware(OwnOrigin, config=config)
    app.add_middleware(Courtesy)
    app.add_middleware(Observing, metrics=metrics)
    app.add_middleware(SecurityHeaders)
    return app
