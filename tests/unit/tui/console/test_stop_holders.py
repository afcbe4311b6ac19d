"""A holder is marked as gone if it was a process of this machine that has ended; others are not marked."""

from __future__ import annotations

import os
import platform
import subprocess
import sys

import pytest
from bot_console.tui.console.robot.robot_model import RobotStop
from bot_console.tui.console.robot.stop_holders import mark_gone
from bot_console.tui.console.robot.stop_link import user


@pytest.fixture(scope="module")
def ended_pid() -> int:
    """The pid of a process that has ended."""
    process = subprocess.Popen([sys.executable, "-c", ""])
    process.wait()
    return process.pid


def is_gone(holder: str, *, here: bool = False) -> bool:
    return mark_gone([RobotStop("key", holder, here=here)])[0].gone


@pytest.mark.skipif(os.name == "nt", reason="Windows cannot probe a process without ending it")
def test_a_process_that_has_ended_is_marked_as_gone(ended_pid: int) -> None:
    assert is_gone(f"bot-console of {user()} (pid {ended_pid})")
    stop = mark_gone([RobotStop("key", f"bot-console of {user()} (pid {ended_pid})", "because")])[0]
    assert stop.who == f"bot-console of {user()} (gone)" and stop.reason == "because"


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux shows the states of processes as files")
def test_a_process_whose_end_its_parent_has_not_noticed_is_marked_as_gone() -> None:
    with subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE) as process:
        assert not is_gone(f"bot-console of {user()} (pid {process.pid})")
        process.kill()
        os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT)  # it has ended, and stays a zombie
        assert is_gone(f"bot-console of {user()} (pid {process.pid})")


def test_other_holders_are_not_marked(ended_pid: int) -> None:
    assert not is_gone(f"bot-console of {user()} (pid {os.getpid()})")
    assert not is_gone(f"bot-console of {user()} (pid {ended_pid})", here=True)
    assert not is_gone(f"bot-console of ben@not-{platform.node()} (pid {ended_pid})")
    assert not is_gone(f"bot-console of {user()} (pid {ended_pid}) and more")
    assert not is_gone(f"bot-console stop of {user()}")
    assert not is_gone("")
    assert RobotStop("key", "ben (pid 3)").who == "ben (pid 3)"
