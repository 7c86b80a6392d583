"""docs/kubernetes holds what docs/service.md promises: nothing shared on disks, and no secrets."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
import yaml

from checker import cli
from checker.base.resources import tool_version

FOLDER = Path(__file__).parent.parent.parent / "docs/kubernetes"
KUSTOMIZATION: dict[str, Any] = yaml.safe_load((FOLDER / "kustomization.yaml").read_text("utf-8"))
RESOURCES: list[dict[str, Any]] = [
    resource
    for name in KUSTOMIZATION["resources"]
    for resource in yaml.safe_load_all((FOLDER / name).read_text("utf-8"))
]
PODS = {
    each["metadata"]["name"]: each["spec"]["template"]["spec"]
    for each in RESOURCES
    if each["kind"] == "Deployment"
}


def test_all_files_take_part() -> None:
    files = {path.name for path in FOLDER.iterdir()} - {"kustomization.yaml"}
    assert files == set(KUSTOMIZATION["resources"])
    assert PODS.keys() == {"web", "worker"} == {each["name"] for each in KUSTOMIZATION["replicas"]}
    assert KUSTOMIZATION["images"] == [{"name": "subt-check", "newTag": tool_version()}]


def test_selectors_find_their_pods() -> None:
    labels = [
        each["spec"]["template"]["metadata"]["labels"]
        for each in RESOURCES
        if each["kind"] == "Deployment"
    ]
    for each in RESOURCES:
        selector = each["spec"]["selector"]
        assert selector.get("matchLabels", selector) in labels


@pytest.mark.parametrize("name", PODS)
def test_a_pod_can_do_little_and_keeps_nothing(name: str) -> None:
    pod, (container,) = PODS[name], PODS[name]["containers"]
    assert pod["securityContext"]["runAsNonRoot"] is True
    assert pod["automountServiceAccountToken"] is False
    may = container["securityContext"]
    assert may["readOnlyRootFilesystem"] is True
    assert may["allowPrivilegeEscalation"] is False
    assert may["capabilities"] == {"drop": ["ALL"]}
    assert container["resources"]["limits"]["memory"]
    assert {mount["mountPath"] for mount in container["volumeMounts"]} == {"/data", "/tmp"}  # noqa: S108
    assert all("emptyDir" in volume for volume in pod["volumes"])


@pytest.mark.parametrize("name", PODS)
def test_what_a_pod_runs_is_an_ordinary_command(name: str) -> None:
    (container,) = PODS[name]["containers"]
    cli.build_parser().parse_args(container["args"])
    sources = [next(iter(source.values()))["name"] for source in container["envFrom"]]
    assert ("subt-check-web" in sources) == (name == "web"), "a worker knows no tokens"
    (generated,) = KUSTOMIZATION["configMapGenerator"]
    assert {generated["name"], "subt-check-shared"} <= set(sources)
    assert any(text.startswith("SUBT_CHECK_STORE=s3://") for text in generated["literals"])
