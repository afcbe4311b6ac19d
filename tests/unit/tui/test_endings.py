"""Descriptions of how processes ended."""

from __future__ import annotations

from dataclasses import replace

import pytest
from bot_console.tui.console.model import ProcessInfo, ProcessState
from bot_console.tui.text.endings import ending_text, endings_of_nodes, exit_text

NOW = 10**18
ENDED = ProcessInfo("k", "zoo-1", ProcessState.CRASHED, nodes=("/a", "/b"), exit_code=1, ended=NOW - 3 * 10**9)


def test_an_ending_says_when_and_how() -> None:
    assert ending_text(ENDED, NOW) == "ended 3 s ago: exit code 1"
    assert ending_text(ENDED, NOW - 3 * 10**9) == "has just ended: exit code 1"
    assert ending_text(replace(ENDED, state=ProcessState.EXITED, exit_code=0), NOW) == "ended 3 s ago: exit code 0"


@pytest.mark.parametrize("state", [ProcessState.RUNNING, ProcessState.STARTING, ProcessState.MISSING])
def test_running_or_never_started_process_has_not_ended(state: ProcessState) -> None:
    assert ending_text(replace(ENDED, state=state), NOW) == "" == ending_text(replace(ENDED, ended=0), NOW)


@pytest.mark.parametrize(("code", "text"), [(2, "exit code 2"), (-9, "SIGKILL (exit code -9)"), (-99, "exit code -99")])
def test_a_signal_is_named(code: int, text: str) -> None:
    assert exit_text(code) == text


def test_a_node_that_runs_in_another_process_has_not_ended() -> None:
    again = ProcessInfo("l", "zoo-2", ProcessState.RUNNING, 7, nodes=("/b",))
    assert endings_of_nodes((ENDED, again), NOW) == {"/a": "ended 3 s ago: exit code 1"}
