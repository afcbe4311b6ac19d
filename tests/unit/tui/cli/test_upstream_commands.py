"""Commands of `ros2` that are answered in a way of our own."""

from __future__ import annotations

import pytest
from bot_console.tui.cli.completion import candidates
from bot_console.tui.cli.main import main


@pytest.mark.parametrize("verb", ["status", "stop"])
def test_there_is_no_daemon_to_stop(capsys: pytest.CaptureFixture[str], verb: str) -> None:
    assert main(["ros2", "daemon", verb]) == 0
    assert capsys.readouterr().out == "The daemon is not running\n"


def test_nor_one_to_start(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["ros2", "daemon", "start"]) == 0
    assert "no daemon is started" in capsys.readouterr().err


@pytest.mark.parametrize("words", [("doctor",), ("wtf",), ("doctor", "--report"), ("doctor", "-iw")])
def test_doctor_looks_at_this_machine(capsys: pytest.CaptureFixture[str], words: tuple[str, ...]) -> None:
    main(["ros2", *words])
    assert "python" in capsys.readouterr().out


def test_they_are_completed() -> None:
    assert {"bag", "daemon", "doctor"} <= set(candidates(["ros2", ""]))
    assert candidates(["ros2", "daemon", "st"]) == ["start", "status", "stop"]
