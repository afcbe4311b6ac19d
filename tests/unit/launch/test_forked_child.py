"""A forked process as a child of a launch."""

from __future__ import annotations

import asyncio
import os
from typing import Any

import pytest
from launch.actions import EmitEvent, ExecuteProcess, RegisterEventHandler, execute_local
from launch.child import streamed_child
from launch.child.forked_child import ForkedChild
from launch.event_handlers import OnProcessStart
from launch.events import Shutdown

from launch import LaunchDescription, LaunchService


class EndedChild(ForkedChild):
    """A child whose exit code is known, and whose output ends with the first signal."""

    def __init__(self) -> None:
        super().__init__("talker", lambda fd, data: None, asyncio.get_running_loop())
        self.on_report(b"pid 4242\nexit 0\n")

    def send_signal(self, signum: int) -> None:
        for stream in tuple(self.open_streams):
            self.pipe_connection_lost(stream, None)
        super().send_signal(signum)


@pytest.fixture
def sent_signals(monkeypatch: pytest.MonkeyPatch) -> list[tuple[int, int]]:
    """The signals that reach the operating system; the output of an ended process is awaited for an hour."""
    sent: list[tuple[int, int]] = []
    monkeypatch.setattr(os, "kill", lambda pid, number: sent.append((pid, number)))
    monkeypatch.setattr(streamed_child, "DRAIN_S", 3600)
    return sent


def test_no_signal_is_sent_to_a_pid_whose_process_has_ended(sent_signals: list[tuple[int, int]]) -> None:
    async def play() -> None:
        child = EndedChild()
        with pytest.raises(ProcessLookupError):
            child.send_signal(2)
        child.close()

    asyncio.run(play())
    assert not sent_signals


def test_launch_is_interrupted_between_the_end_of_a_process_and_that_of_its_output(
    sent_signals: list[tuple[int, int]], monkeypatch: pytest.MonkeyPatch
) -> None:
    async def start_child(*_: object, **__: object) -> EndedChild:
        return EndedChild()

    monkeypatch.setattr(execute_local, "start_child", start_child)
    talker: Any = ExecuteProcess(cmd=["talker"])
    interrupt = EmitEvent(event=Shutdown(reason="ctrl-c (SIGINT)", due_to_sigint=True))
    service = LaunchService()
    service.include_launch_description(
        LaunchDescription(
            [RegisterEventHandler(OnProcessStart(target_action=talker, on_start=[interrupt])), talker],
        )
    )
    assert service.run() == 0
    assert not sent_signals
