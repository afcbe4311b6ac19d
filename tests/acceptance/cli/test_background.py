"""A robot in the background: started, found, not started twice, and ended, from separate terminals."""

from __future__ import annotations

import json
import os
import re
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest
from polling import until

if os.name == "nt":
    pytest.skip("needs Unix sockets", allow_module_level=True)

from bot_console.runtime.rmw.zenoh.domain.folder import domain_folder
from bot_console.tui.console.model import ProcessInfo, ProcessState
from bot_console.tui.session.launch_host.address import connect_to_host, host_addresses
from bot_console.tui.session.launch_host.combined import CombinedLauncher, OtherHosts
from bot_console.tui.session.launch_host.proxy import HostedLauncher
from launcher_bench import WAITS
from processes.command_line import run_cli

TIMEOUT_S = 240.0
"""Seconds after which a test gives up; nothing is measured by it."""


@pytest.fixture
def state(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    monkeypatch.setenv("BOT_CONSOLE_USER_DIR", str(tmp_path))
    monkeypatch.setenv("ROS_HOME", str(tmp_path))
    yield tmp_path
    run_cli("down")


def test_background_robot_is_started_shown_and_ended(state: Path) -> None:
    assert run_cli("status").returncode == 1
    assert run_cli("down").returncode == 1
    started = run_cli("up", "warehouse", "--seed", "1")
    assert started.returncode == 0, started.stderr
    assert "bot-console attach" in started.stdout
    reported = run_cli("status")
    assert reported.returncode == 0 and "warehouse" in reported.stdout and "/simulator" in reported.stdout
    assert run_cli("stop", "the arm swings").returncode == 0
    assert re.search(
        "^held by bot-console stop of .*: the arm swings; bot-console release", run_cli("status").stdout, re.M
    )
    assert run_cli("release").returncode == 0 and "held by" not in run_cli("status").stdout
    again = run_cli("up")
    assert again.returncode == 1 and "already running" in again.stderr
    apart = run_cli("--headless", "--duration", "0.5")
    assert "runs in isolation" in apart.stderr and apart.returncode == 0
    ended = run_cli("down")
    assert ended.returncode == 0 and ended.stdout.startswith("ended: ")
    assert run_cli("status").returncode == 1
    (log,) = (state / "state" / "systems").glob("*.log")
    text = log.read_text(encoding="utf-8")
    assert re.search(r"\[simulator\]: Emergency stop: locked by .*: its system is being ended", text)
    assert "simulator_node-1]: process has finished cleanly" in text
    assert "Traceback" not in text
    kept = json.loads((state / "state" / "stops" / "domain-0.json").read_text())["robots"]["/"]
    assert not kept["stops"] and "bot-console release of" in kept["released"][0][1]


def test_frozen_or_killed_system_is_ended_without_leftovers(state: Path) -> None:
    started = run_cli("up")
    pid = int(re.search(r"process (\d+)", started.stdout)[1])  # pyright: ignore[reportOptionalSubscript] -- told
    assert run_cli("stop", "the arm swings").returncode == 0
    os.kill(pid, signal.SIGKILL)
    until(lambda: run_cli("status").returncode, "its end")
    started = run_cli("up")
    assert re.search("^held by .*: the arm swings; bot-console release", started.stdout, re.M), "nobody released it"
    assert run_cli("release").returncode == 0
    assert [Path(each).stem for each in host_addresses(domain_folder(0))] == re.findall(
        r"process (\d+)", started.stdout
    )
    pid = int(re.search(r"process (\d+)", started.stdout)[1])  # pyright: ignore[reportOptionalSubscript] -- told
    os.kill(pid, signal.SIGSTOP)
    assert run_cli("down").returncode == 0
    log = next(each for each in (state / "state" / "systems").glob("*.log") if str(each) in started.stdout)
    assert "process has finished cleanly" in log.read_text(encoding="utf-8")
    assert not host_addresses(domain_folder(0))


LAUNCH = """
from launch import LaunchDescription
from launch_ros.actions import Node

def generate_launch_description():
    return LaunchDescription([Node(executable="{folder}/waiter.py", name="waiter")])
"""


def process(launcher: CombinedLauncher) -> ProcessInfo | None:
    """The only process."""
    return next(iter(launcher.info().processes), None)


@pytest.mark.slow
def test_processes_are_visible_and_controllable_from_changing_consoles(state: Path) -> None:
    (state / "waiter.py").write_text(WAITS)
    file = state / "system.launch.py"
    file.write_text(LAUNCH.format(folder=state))
    assert run_cli("up", "--launch", str(file), "--no-simulator").returncode == 0
    folder = domain_folder(0)
    lines: list[str] = []

    def enter(gate: str) -> HostedLauncher | None:
        connection = connect_to_host(gate)
        return connection and HostedLauncher(
            connection, lambda *record: lines.append(record[3]), lambda *line: None, owner=False
        )

    def attached() -> CombinedLauncher:
        return CombinedLauncher(start_nothing, tuple, OtherHosts(lambda: host_addresses(folder), enter))

    first, second = attached(), attached()
    begun = until(lambda: process(first), "the process")
    assert (begun.state, begun.group) == (ProcessState.RUNNING, ("system.launch.py",))
    until(lambda: "up" in lines, "what it has printed before")
    answer = first.restart(begun.key).result(TIMEOUT_S)
    assert answer.ok, answer
    again = until(lambda: (each := process(second)) and each.restarts == 1 and each, "the restart")
    assert again.pid != begun.pid
    first.close()
    assert second.stop(again.key).result(TIMEOUT_S).ok and run_cli("status").returncode == 0
    assert run_cli("down").returncode == 0
    until(lambda: not second.info().processes, "its end")
    assert any("has gone" in each.text for each in second.info().timeline)
    assert not host_addresses(folder)
    second.close()


def start_nothing() -> tuple[str, HostedLauncher]:
    """Nothing is launched from these consoles."""
    raise AssertionError


def test_system_that_cannot_start_is_reported(state: Path) -> None:
    failed = run_cli("up", "--launch", "nowhere.launch.py")
    assert failed.returncode == 1
    assert failed.stderr == "there is no launch file nowhere.launch.py\n"
    (state / "wrong.launch.py").write_text("a = 1\n\ndef (:\n")
    failed = run_cli("up", "--launch", str(state / "wrong.launch.py"))
    assert failed.returncode == 1 and "ended with exit code 1" in failed.stderr
    (log,) = (state / "state" / "systems").glob("*.log")
    assert "wrong.launch.py, line 3: syntax error" in log.read_text(encoding="utf-8")
    assert run_cli("status").returncode == 1
