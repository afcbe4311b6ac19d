"""`up --serve`: the router for other machines has its own log, which is deleted with the system's."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import pytest
from bot_console.tui.cli.verbs import background
from bot_console.tui.session import system_log


def test_router_does_not_write_to_a_rotating_log(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    there = iter([[], ["/simulator"]])
    written: dict[str, Path] = {}

    def start(words: list[str], *, stdout, **_: object) -> SimpleNamespace:
        written["router" if "router" in words else "system"] = Path(stdout.name)
        return SimpleNamespace(pid=1, poll=lambda: None)

    monkeypatch.setattr(background, "take_part", lambda: "")
    monkeypatch.setattr(background, "_running_system", lambda: None)
    monkeypatch.setattr(background, "running_robot_nodes", lambda: next(there))
    monkeypatch.setattr(background, "_is_program", lambda pid, word: False)
    monkeypatch.setattr(background.subprocess, "Popen", start)
    monkeypatch.setattr(system_log, "state_folder", lambda: tmp_path)
    assert background.up(["--serve", "tcp/127.0.0.1:7447"]) == 1
    assert written["router"] in system_log.parts(written["system"])
    assert str(written["router"]) in capsys.readouterr().err
