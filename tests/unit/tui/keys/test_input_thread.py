"""Keys arrive, and the reading thread ends as soon as it is asked to, not at its next timeout."""

from __future__ import annotations

import os
import pty
import threading
import tty
from collections.abc import Iterator
from types import SimpleNamespace
from typing import Any

import pytest
from bot_console.tui.keys import input_thread
from bot_console.tui.keys.input_thread import NoStopKeyWatch, WakeableEvent, read_keys

TIMEOUT_S = 240.0
"""Seconds after which a test gives up; nothing is measured by it."""


class Rig:
    """A driver on one end of a pseudo-terminal, and its thread."""

    def __init__(self) -> None:
        self.master, self.slave = pty.openpty()
        tty.setraw(self.slave)
        self.gone = False
        self.came = threading.Semaphore(0)
        self.events: list[Any] = []
        self.driver: Any = SimpleNamespace(_debug=False, fileno=self.slave, process_message=self._take)
        self.driver.exit_event = WakeableEvent()
        self.watch: Any = NoStopKeyWatch()
        self.start()

    def start(self) -> None:
        taking = (self.driver, self.driver.exit_event, self.watch)
        self.thread = threading.Thread(target=read_keys, args=taking, daemon=True)
        self.thread.start()

    def _take(self, event: Any) -> None:
        self.events.append(event)
        self.came.release()

    def types(self, data: bytes, count: int = 1) -> list[str]:
        """Type bytes; return the keys of the resulting events."""
        before = len(self.events)
        os.write(self.master, data)
        for _ in range(count):
            assert self.came.acquire(timeout=TIMEOUT_S)
        return [each.key for each in self.events[before:]]

    def end(self) -> bool:
        """End the thread as a driver does; return whether it has ended."""
        self.driver.exit_event.set()
        self.thread.join(TIMEOUT_S)
        self.driver.exit_event.clear()
        return not self.thread.is_alive()

    def close(self) -> None:
        """Close the terminal, whose other end may be closed already."""
        os.close(self.slave)
        if not self.gone:
            os.close(self.master)


@pytest.fixture
def rig(monkeypatch: pytest.MonkeyPatch) -> Iterator[Rig]:
    monkeypatch.setattr(input_thread, "ESCAPE_TIMEOUT_S", 10 * TIMEOUT_S)  # a thread that waits for it never ends
    rig = Rig()
    yield rig
    rig.end()
    rig.close()


def test_keys_arrive_in_order(rig: Rig) -> None:
    assert rig.types(b"q!\x1b[A", 3) == ["q", "exclamation_mark", "up"]


@pytest.mark.parametrize("key", ["!", "\r", ":", "-", " "])
def test_escape_followed_by_a_key_is_two_keys(rig: Rig, key: str) -> None:
    alone = rig.types(key.encode())
    assert rig.types(f"\x1b{key}".encode(), 2) == ["escape", *alone]


def test_a_character_after_esc_may_have_had_alt_and_keys_of_several_bytes_stay_whole(rig: Rig) -> None:
    assert rig.types(b"\x1bq\x1b1", 2) == ["alt+q", "alt+1"] and rig.types(b"\x1bQx", 2) == ["alt+shift+q", "x"]
    assert rig.types(b"\x1b[A\x1bOP\x1b[1;3A\x1b\x7f\x1bb", 5) == ["up", "f1", "alt+up", "ctrl+w", "ctrl+left"]


def test_thread_ends_at_once_and_can_be_restarted(rig: Rig) -> None:
    for character in "ab":
        assert rig.types(character.encode()) == [character]
        assert rig.end()
        rig.start()


def test_thread_ends_when_the_terminal_closes(rig: Rig) -> None:
    assert rig.types(b"x") == ["x"]
    os.close(rig.master)
    rig.gone = True
    rig.thread.join(TIMEOUT_S)
    assert not rig.thread.is_alive()


def test_invalid_utf_8_does_not_end_the_thread(rig: Rig) -> None:
    rig.types(b"\xff\xfe", 2)
    assert rig.types(b"x") == ["x"]


def test_thread_survives_closed_descriptors(rig: Rig, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(input_thread, "ESCAPE_TIMEOUT_S", 0.01)
    rig.types(b"a")
    ending = rig.driver.exit_event
    for each in list(ending._ends):
        os.close(each)
    assert rig.types(b"b") == ["b"]
    assert rig.end()


def test_thread_stopped_before_its_start_ends() -> None:
    ending = WakeableEvent()
    ending.set()
    reading, writing = os.pipe()
    assert not ending.readable(reading, TIMEOUT_S)
    ending.clear()
    os.write(writing, b"x")
    assert ending.readable(reading, TIMEOUT_S) and not ending.is_set()
    for each in (reading, writing):
        os.close(each)
