"""The API keeps what its description says, whatever schemathesis thinks of."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory

import schemathesis
from hypothesis import HealthCheck, settings
from schemathesis import checks

from checker.store.store import Store
from checker.web.app import create_app
from checker.web.config import Config
from tests.web.board import DONE, ID, BoardJobs

# The tests are made of the description, so that no fixture can give the folder.
DATA = TemporaryDirectory()
APP = create_app(BoardJobs({ID: DONE}), Store(Path(DATA.name)), Config())
HOST = {"Host": "localhost"}
DESCRIPTION = schemathesis.openapi.from_asgi("/api/openapi.json", APP, headers=HOST)
FEW = settings(max_examples=5, suppress_health_check=list(HealthCheck))
# A form may be right by its schema, which knows no archives, and be refused all the same.
WITHOUT = [checks.positive_data_acceptance]


@DESCRIPTION.parametrize()
@FEW
def test_any_request_is_answered_as_described(case: schemathesis.Case) -> None:
    case.call_and_validate(headers=HOST, excluded_checks=WITHOUT)


@DESCRIPTION.include(path_regex="{id}").parametrize()
@FEW
def test_any_request_about_a_check_is_answered_as_described(case: schemathesis.Case) -> None:
    case.path_parameters["id"] = ID
    case.call_and_validate(headers=HOST, excluded_checks=WITHOUT)
