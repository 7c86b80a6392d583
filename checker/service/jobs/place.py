"""Where the engine keeps its books."""

from __future__ import annotations

import os
from urllib.parse import quote

from checker.service.store.place import DATABASE, data_folder


def database_url() -> str:
    """Return the address of the database: `SUBT_CHECK_DATABASE_URL`, else a file with the data."""
    own = os.environ.get("SUBT_CHECK_DATABASE_URL", "")
    # SQLAlchemy takes what follows a `?` for options.
    return own or f"sqlite:///{quote(str(data_folder() / DATABASE))}"
