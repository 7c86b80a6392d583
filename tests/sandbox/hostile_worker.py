"""A worker whose checks are made by `hostile_checker`: `python -m tests.sandbox.hostile_worker`.

The rest is in the environment, as for `subt-check worker`.
"""

from __future__ import annotations

from checker.service.jobs import children
from checker.service.jobs.durable.worker import WorkerOptions, work
from checker.service.jobs.place import database_url
from checker.service.store.place import data_folder
from checker.service.store.store import Store


def main() -> None:
    children.MODULE = "hostile_checker"
    work(WorkerOptions(database_url(), Store(data_folder())))


if __name__ == "__main__":
    main()
