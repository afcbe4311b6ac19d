"""Two simultaneous `bot-console up`, and one ended during its start: at most one system, which can always be ended."""

from __future__ import annotations

import json
import os
import signal
import threading
from pathlib import Path
from types import SimpleNamespace

import pytest
from bot_console.tui.cli.verbs import background
from bot_console.tui.session import system_log
from bot_console.tui.session.embedded import start_lock as module
from bot_console.tui.session.embedded.start_lock import start_lock

if os.name == "nt":
    pytest.skip("needs POSIX signals", allow_module_level=True)

TIMEOUT_S = 240.0


def test_second_start_waits_for_the_first(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    waits, lock, seen = threading.Event(), tmp_path / "lock", list[str]()
    monkeypatch.setattr(module.time, "sleep", lambda seconds: waits.set())
    monkeypatch.setattr(module, "SIGNALS", [])  # Only a main thread may block these signals.

    def second() -> None:
        with start_lock(lock, TIMEOUT_S) as got:
            seen.append(f"second {got}")

    with start_lock(lock, TIMEOUT_S) as got:
        other = threading.Thread(target=second)
        other.start()
        assert waits.wait(TIMEOUT_S)
        seen.append(f"first {got}")
    other.join(TIMEOUT_S)
    assert seen == ["first True", "second True"]


def test_wait_for_another_start_ends_at_its_timeout(tmp_path: Path) -> None:
    with start_lock(tmp_path / "lock", 0.0), start_lock(tmp_path / "lock", 0.0) as got:
        assert not got


@pytest.fixture
def started_processes(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> list[object]:
    """Replaces the process that `up` starts; records this process's id instead."""
    calls: list[object] = []

    def start(words: object, **_: object) -> SimpleNamespace:
        calls.append(words)
        return SimpleNamespace(pid=os.getpid(), poll=lambda: None)

    monkeypatch.setattr(background.subprocess, "Popen", start)
    monkeypatch.setattr(background, "take_part", lambda: "")
    monkeypatch.setattr(background, "_file", lambda: tmp_path / "background.json")
    monkeypatch.setattr(background, "_is_program", lambda pid, word: True)
    monkeypatch.setattr(background, "_accepts_consoles", lambda pid: True)
    monkeypatch.setattr(background, "running_robot_nodes", lambda: ["/simulator"] if calls else [])
    monkeypatch.setattr(system_log, "state_folder", lambda: tmp_path)
    return calls


def test_system_that_started_during_the_search_is_not_doubled(
    started_processes: list[object], monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    def begins_meanwhile() -> list[str]:
        text = json.dumps({"pid": 7, "words": ["outdoor"], "log": "its.log"})
        (tmp_path / "background.json").write_text(text)
        return []

    monkeypatch.setattr(background, "running_robot_nodes", begins_meanwhile)
    assert background.up([]) == 1
    assert "process 7 (outdoor)" in capsys.readouterr().err and not started_processes


def test_signal_during_start_waits_until_system_is_recorded(
    started_processes: list[object], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    save = background.save_file
    monkeypatch.setattr(module, "SIGNALS", [signal.SIGUSR1])  # Not SIGINT, which may be ignored where tests run.
    before = signal.signal(signal.SIGUSR1, signal.default_int_handler)

    def interrupted(path: Path, text: str) -> None:
        os.kill(os.getpid(), signal.SIGUSR1)
        save(path, text)

    monkeypatch.setattr(background, "save_file", interrupted)
    with pytest.raises(KeyboardInterrupt):
        background.up([])
    assert started_processes and (tmp_path / "background.json").exists()
    assert signal.signal(signal.SIGUSR1, before) is signal.default_int_handler


def test_interrupt_during_start_reports_how_to_end_it(
    started_processes: list[object], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def polls() -> list[str]:
        if started_processes:
            raise KeyboardInterrupt
        return []

    monkeypatch.setattr(background, "running_robot_nodes", polls)
    with pytest.raises(KeyboardInterrupt):
        background.up([])
    assert "it is still starting: process" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "what"), [([], "no robot was found"), (["--launch", __file__], "none of the programs that it")]
)
def test_system_that_does_not_come_up_in_time_is_not_reported_as_running(
    started_processes: list[object],
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    words: list[str],
    what: str,
) -> None:
    monkeypatch.setattr(background, "START_TIMEOUT_S", 0.0)
    monkeypatch.setattr(background, "running_robot_nodes", list)
    monkeypatch.setattr(background, "_accepts_consoles", lambda pid: False)
    assert background.up(words) == 1
    message = capsys.readouterr()
    assert message.err.startswith(what) and f"process {os.getpid()}" in message.err and not message.out


def test_unreachable_system_is_not_started(
    started_processes: list[object], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF")
    assert background.up([]) == 1
    assert "could not be seen or stopped" in capsys.readouterr().err and not started_processes
