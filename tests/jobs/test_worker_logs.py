"""What a worker says is JSON lines, with what DBOS says, and nothing that opens a report."""

from __future__ import annotations

import json
from pathlib import Path

from checker.service.jobs.durable.receipts import key_of_check
from checker.service.jobs.port import Stage
from tests.jobs.site import site_in


def test_workers_log_json_lines_without_ids(tmp_path: Path) -> None:
    with (tmp_path / "said").open("wb") as said:
        site = site_in(tmp_path, f"sqlite:///{tmp_path}/jobs.sqlite")
        site.stderr = said
        worker = site.worker("a-worker")
        fails, warns = site.receipt("raises"), site.receipt("warns")
        assert site.end(fails.id).stage is Stage.FAILED
        assert site.end(warns.id).stage is Stage.DONE
        worker.terminate()
        worker.wait(60)
        site.close()
    text = (tmp_path / "said").read_text()
    lines = [json.loads(line) for line in text.splitlines()]
    told = {(line["level"], line["logger"].partition(".")[0]) for line in lines}
    assert told == {("info", "checker"), ("error", "checker"), ("warning", "dbos")} | (
        told & {("warning", "checker")}  # a machine without a sandbox
    )
    [fault] = [line for line in lines if line["level"] == "error"]
    assert "as a fault of ours would" in fault["trace"]
    [ended] = [line for line in lines if line.get("outcome") == "done"]
    assert (ended["stage"], ended["try"], ended["seconds"] > 0) == ("trial", 1, True)
    assert {fault["check"], ended["check"]} == {
        key_of_check(each.id)[:12] for each in (fails, warns)
    }
    assert not [word for each in (fails, warns) for word in (each.id, each.secret) if word in text]
