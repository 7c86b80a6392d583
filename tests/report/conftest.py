"""Reports of real packages, and the public schemas of the formats that have one."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import jsonschema
import pytest
from lxml import etree

from checker.pipeline import check_paths
from checker.report.report import Report
from tests.conftest import SAMPLES

SCHEMAS = Path(sys.prefix) / "schemas"


@pytest.fixture(scope="session")
def sarif() -> jsonschema.Draft7Validator:
    """The schema of SARIF 2.1.0 as OASIS published it."""
    path = SCHEMAS / "sarif-schema-2.1.0.json"
    assert path.is_file(), f"{path} is missing; run: scripts/schemas {sys.executable}"
    schema = json.loads(path.read_text("utf-8"))
    # This copy is of the last draft; the standard (3.35.3) says `status` of a suppression.
    suppression = schema["definitions"]["suppression"]["properties"]
    if "state" in suppression:
        suppression["status"] = suppression.pop("state")
    return jsonschema.Draft7Validator(schema)


@pytest.fixture(scope="session")
def junit() -> etree.XMLSchema:
    """The schema of JUnit reports that Jenkins' xUnit plugin goes by."""
    path = SCHEMAS / "junit-10.xsd"
    assert path.is_file(), f"{path} is missing; run: scripts/schemas {sys.executable}"
    return etree.XMLSchema(etree.parse(path))


@pytest.fixture(scope="session")
def of_samples() -> Report:
    """The report of all samples, without trials."""
    return check_paths([SAMPLES], {"trial": False})


@pytest.fixture(scope="session")
def of_a_trial() -> Report:
    """The report of a sample that was driven."""
    return check_paths([SAMPLES / "subtcheck_crawler_sensor_config_1"], {})


@pytest.fixture(scope="session")
def of_corpus(corpus: Path) -> Report:
    """The report of all real packages, without trials."""
    return check_paths([corpus], {"trial": False})
