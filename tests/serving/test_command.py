"""The commands of the service say what is missing, and what they take."""

from __future__ import annotations

import pytest

from checker import cli


@pytest.mark.parametrize(
    "words",
    [
        *(["serve", "--port", "65536"], ["serve", "--port", "-1"], ["serve", "--port", "²"]),
        *(["serve", "--workers", "-1"], ["serve", "--workers", "many"], ["serve", "here"]),
        *(["serve", "--behind-proxy", "proxy"], ["serve", "--behind-proxy", "10.0.0.1/8"]),
        *(
            ["admin"],
            ["admin", "requeue"],
            ["admin", "cancel"],
            ["admin", "requeue", "k", "--failed"],
        ),
        *(["worker", "--jobs", "0"], ["submit", "a.zip"], ["submit", "--server", "http://a"]),
    ],
)
def test_what_the_command_line_does_not_take(
    words: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as ended:
        cli.main(words)
    assert ended.value.code == 2
    said = capsys.readouterr().err
    assert said.startswith(f"subt-check {words[0]}")
    assert said.count("\n") == 2


@pytest.mark.parametrize("name", ["serve", "worker", "submit", "admin"])
def test_each_has_a_help(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        cli.main([name, "--help"])
    assert not ended.value.code
    assert f"usage: subt-check {name}" in capsys.readouterr().out
