"""Leaving the terminal: the editor command with its line, and a robot that is held before the console is suspended."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Callable, Coroutine
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from bot_console.tui.terminal.editor import editor_command
from bot_console.tui.terminal.suspension import (
    ASLEEP,
    EMPTY,
    STOP_POLL_S,
    STOP_TIMEOUT_S,
    TerminalHandover,
    clear_screen_before_leaving,
    resume_after_any_stop,
)
from fakes.console import FakeConsole
from samples import live


@pytest.fixture
def file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    for name in ("vi", "code", "my editor"):
        (tmp_path / name).write_text("#!/bin/sh\n")
        (tmp_path / name).chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    path = tmp_path / "a node.py"
    path.write_text("x\n")
    return str(path)


def test_editor_command_contains_the_line_in_its_syntax(file: str) -> None:
    assert editor_command(file, 7, {"EDITOR": "vi -R"}) == ["vi", "-R", "+7", file]
    assert editor_command(file, 0, {"EDITOR": "vi"}) == ["vi", file]
    assert editor_command(file, 7, {"VISUAL": "code", "EDITOR": "vi"}) == ["code", "--wait", "--goto", f"{file}:7"]
    assert editor_command(file, 7, {"EDITOR": "'my editor'"}) == ["my editor", "+7", file]


@pytest.mark.parametrize(
    ("environment", "hint"),
    [({}, "export EDITOR=vi"), ({"EDITOR": "emacs"}, "there is no emacs"), ({"EDITOR": "'vi"}, "without its twin")],
)
def test_missing_editor_or_file_is_reported(file: str, environment: dict[str, str], hint: str) -> None:
    with pytest.raises(ValueError, match=hint):
        editor_command(file, 7, environment)
    with pytest.raises(ValueError, match="not on this machine"):
        editor_command(file + "x", 7, {"EDITOR": "vi"})


class Shell:
    """Replaces the app: records the calls in order."""

    def __init__(self) -> None:
        self.done: list[str] = []
        self.timers: list[Callable[[], object]] = []

    def notify(self, text: str, **_: Any) -> None:
        self.done.append(text)

    def set_timer(self, delay: float, callback: Callable[[], object]) -> None:
        self.timers.append(callback)

    def action_suspend_process(self) -> None:
        self.done.append("asleep")

    def redraw(self) -> None:
        self.done.append("redraw")


def make_leaving(console: FakeConsole, *, holds: bool = True) -> tuple[TerminalHandover, Shell]:
    shell: Any = Shell()
    return TerminalHandover(shell, console, shell.redraw, holds=holds), shell


def test_the_robot_is_held_before_the_terminal_is_left() -> None:
    console = live()[0]
    console.change(drive=replace(console.current.drive, lockable=True, stop_confirmed=False))
    away, shell = make_leaving(console)
    reasons: list[Any] = []
    console.drive.stop = lambda hold=True, reason="": reasons.append((hold, reason))  # type: ignore[method-assign]
    away.sleep()
    away.sleep()
    assert reasons == [(True, ASLEEP)] and shell.done == []
    shell.timers.pop()()
    assert shell.done == []
    console.change(drive=replace(console.current.drive, stop_confirmed=True))
    shell.timers.pop()()
    assert shell.done == ["asleep", "The robot was held meanwhile, and stays held.", "redraw"]


def test_unacknowledged_stop_is_awaited_only_for_a_limited_time() -> None:
    console = live()[0]
    console.change(drive=replace(console.current.drive, lockable=True, stop_confirmed=False))
    away, shell = make_leaving(console)
    console.drive.stop = lambda hold=True, reason="": None  # type: ignore[method-assign]
    away.sleep()
    for _ in range(round(STOP_TIMEOUT_S / STOP_POLL_S) + 1):
        if shell.timers:
            shell.timers.pop()()
    assert shell.done[:1] == ["asleep"]


def test_console_that_may_not_release_does_not_hold_the_robot() -> None:
    console = live()[0]
    away, shell = make_leaving(console, holds=False)
    away.sleep()
    assert shell.done == ["asleep", "redraw"] and not [each for each in console.asked if each[0] == "all_stop"]


class Driver:
    """Replaces Textual's driver: records the calls in order."""

    def __init__(self) -> None:
        self.done: list[str] = []
        self._writer_thread: Any = None
        self.then: Callable[[], object] = lambda: None

    def suspend_application_mode(self) -> None:
        self.done.append("left")
        self._writer_thread = None

    def resume_application_mode(self) -> None:
        self.done.append("set up")
        self._writer_thread = threading.current_thread()
        then, self.then = self.then, lambda: None
        then()


def with_driver(play: Callable[[Driver], Coroutine[None, None, None]]) -> None:
    """Play a scene with a driver that can be resumed; nothing is set up at first."""

    async def main() -> None:
        driver = Driver()
        resume_after_any_stop(driver)
        await play(driver)

    asyncio.run(main())


def test_a_terminal_that_was_not_left_is_left_and_set_up_again_outside_the_signal_handler() -> None:
    async def play(driver: Driver) -> None:
        driver.resume_application_mode()
        assert driver.done == ["set up"]
        driver.resume_application_mode()
        driver.resume_application_mode()
        assert driver.done == ["set up"], "the code that a signal handler interrupts may hold a lock that this needs"
        await asyncio.sleep(0)
        assert driver.done == ["set up", "left", "set up"]

    with_driver(play)


def test_a_terminal_that_was_left_meanwhile_is_not_set_up_again() -> None:
    async def play(driver: Driver) -> None:
        driver.resume_application_mode()
        driver.resume_application_mode()
        driver.suspend_application_mode()
        await asyncio.sleep(0)
        assert driver.done == ["set up", "left"]

    with_driver(play)


def test_concurrent_resumes_are_serialised() -> None:
    async def play(driver: Driver) -> None:
        driver.then = driver.resume_application_mode
        driver.resume_application_mode()
        assert driver.done == ["set up", "left", "set up"]

    with_driver(play)


def test_screen_is_cleared_on_suspension() -> None:
    done: list[str] = []
    driver: Any = SimpleNamespace(write=done.append, stop_application_mode=lambda: done.append("left"))
    clear_screen_before_leaving(driver)
    driver.stop_application_mode()
    assert done == [EMPTY, "left"]
