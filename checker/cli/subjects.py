"""The packages at a path, each read as the command line asks."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from checker.base.cache import NO_CACHE, Cache, cache_folder
from checker.engine.subject import Subject
from checker.model.devices.known import known_devices
from checker.package.inputs import with_package_path
from checker.package.package import Package
from checker.pipeline import Task
from checker.settings import Settings


@contextmanager
def subject_of(package: Package, task: Task) -> Iterator[tuple[Subject, Settings]]:
    """Open a package of a task, with its settings, the target detected.

    Raises:
        InvalidSettings: The settings name what does not exist.
    """
    settings = task.settings_for(package)
    package = with_package_path(package, settings.package_path)
    settings = settings.for_package(package)
    subject = Subject(
        package,
        Cache(cache_folder()) if settings.cache else NO_CACHE,
        devices=known_devices(settings.devices),
        xacro_args=settings.xacro_args,
    )
    try:
        yield subject, settings
    finally:
        subject.close()
