"""A running console, and what a second and a third terminal see and change: with real processes."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from processes.command_line import run_cli

sys.path.insert(0, str(Path(__file__).parent))
from terminal import Terminal

if os.name == "nt":
    pytest.skip("needs Unix sockets", allow_module_level=True)

CONSOLE = ["-m", "bot_console.tui"]
SOCKETS = f"/tmp/bct-{os.getpid()}"


@pytest.fixture(scope="module")
def console(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Terminal]:
    """One console with its robot; each test leaves it unchanged."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("BOT_CONSOLE_SOCKET_DIR", SOCKETS)
        patch.setenv("BOT_CONSOLE_USER_DIR", f"{SOCKETS}-user")
        with Terminal([*CONSOLE, "--seed", "1"], tmp_path_factory.mktemp("console")) as terminal:
            terminal.read_until(lambda: b"robot_navigator" in terminal.output, "the robot's nodes")
            yield terminal
    shutil.rmtree(SOCKETS, ignore_errors=True)
    shutil.rmtree(f"{SOCKETS}-user", ignore_errors=True)


@pytest.fixture(autouse=True)
def same_folder(console: Terminal, monkeypatch: pytest.MonkeyPatch, socket_folder: str) -> None:
    """Make verbs use the console of this file."""
    monkeypatch.setenv("BOT_CONSOLE_SOCKET_DIR", SOCKETS)
    monkeypatch.setenv("BOT_CONSOLE_USER_DIR", f"{SOCKETS}-user")


def speed() -> float:
    return float(run_cli("topic", "echo", "--once", "/odom", "--field", "twist.twist.linear.x").stdout.split()[0])


def test_verbs_in_a_second_terminal_reach_the_robot(console: Terminal) -> None:
    refused = run_cli("param", "set", "/robot_navigator", "max_speed", "10.0")
    assert "out of range" in refused.stderr + refused.stdout
    assert run_cli("param", "set", "/robot_navigator", "max_speed", "2.0").stdout == "Set parameter successful\n"
    assert run_cli("param", "get", "/robot_navigator", "max_speed").stdout == "Double value is: 2.0\n"
    console.output = b""
    assert run_cli("stop", "a test").returncode == 0
    console.read_until(lambda: b"ALL STOP" in console.output, "the lock on the first screen")
    console.read_until(lambda: abs(speed()) < 0.05, "the robot at rest, which brakes from 2 m/s")
    assert run_cli("release").returncode == 0
    console.read_until(lambda: speed() > 0.1, "the robot that drives again")


def test_second_console_asks_to_attach_and_leaves_the_robot_running(console: Terminal, tmp_path: Path) -> None:
    with Terminal(CONSOLE, tmp_path) as asking:
        asking.read_until(lambda: b"Attach the console" in asking.output, "the question")
        assert b"/simulator" in asking.output
        asking.type("n\n")
        assert asking.wait() == 1

    with Terminal([*CONSOLE, "attach"], tmp_path) as attached:
        attached.read_until(lambda: b"robot_navigator" in attached.output, "the robot's nodes in an attached console")
        console.output = attached.output = b""
        attached.type("!")
        console.read_until(lambda: b"ALL STOP" in console.output, "the lock of another console on the first screen")
        attached.read_until(lambda: b"releases" in attached.output, "the lock that the next key releases")
        attached.type("!")
        console.read_until(lambda: speed() > 0.1, "the robot that drives again")
        attached.type("q")
        assert attached.wait() == 0
    assert console.process.poll() is None
    console.read_until(lambda: speed() > 0.1, "the robot that drives on")


@pytest.mark.slow
def test_signal_makes_console_write_its_stacks_and_continue(console: Terminal) -> None:
    stacks = console.stacks()
    assert "Current thread" in stacks and "_writer_thread.py" in stacks
    assert f"process {console.process.pid}: screens 1" in stacks
    console.output = b""
    assert run_cli("stop", "a test").returncode == 0
    console.read_until(lambda: b"ALL STOP" in console.output, "the lock on the first screen")
    assert run_cli("release").returncode == 0
