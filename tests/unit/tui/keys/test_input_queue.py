"""Input that the app has not handled yet is merged, so that no flood keeps it busy."""

from __future__ import annotations

from collections import deque
from typing import Any

import pytest
from bot_console.tui.keys.input_queue import MAX_WHEEL_STEPS, InputQueue, merge
from textual import events
from textual.geometry import Size
from textual.message import Message


def moved(x: int, delta: int = 1) -> events.MouseMove:
    return events.MouseMove(None, x, 0, delta, 0, 0, shift=False, meta=False, ctrl=False)


def wheel(kind: type[events.MouseEvent] = events.MouseScrollDown) -> events.MouseEvent:
    return kind(None, 0, 0, 0, 0, 0, shift=False, meta=False, ctrl=False)


def resized(width: int) -> events.Resize:
    return events.Resize(Size(width, 24), Size(width, 24))


def merge_all(*messages: Message) -> list[Message]:
    waiting: deque[Message] = deque()
    for each in messages:
        merge(waiting, each)
    return [*waiting]


class Loop:
    """An event loop that runs scheduled functions when the test says so."""

    def __init__(self) -> None:
        self.due: deque[Any] = deque()

    def call_soon_threadsafe(self, call: Any, *arguments: Any) -> None:
        self.due.append(lambda: call(*arguments))

    call_soon = call_soon_threadsafe


class App:
    """An app that keeps its messages until the test lets it handle them."""

    def __init__(self) -> None:
        self.messages: list[Any] = []
        self.screen_stack: list[Any] = []
        self.closed = False

    def post_message(self, message: Any) -> bool:
        self.messages.append(message)
        return not self.closed

    def call_later(self, call: Any) -> bool:
        return self.post_message(call)

    def handle(self) -> list[Message]:
        """Handle all messages; return those that were events."""
        seen: list[Message] = []
        while self.messages:
            message = self.messages.pop(0)
            if isinstance(message, Message):
                seen.append(message)
            else:
                message()
        return seen


def test_moves_and_resizes_are_merged_and_keep_the_whole_distance() -> None:
    end, size = moved(9), resized(99)
    assert merge_all(moved(1), resized(80), moved(2), resized(81), end, size) == [end, size]
    assert end.delta_x == 3


@pytest.mark.parametrize("between", [events.Key("x", "x"), wheel(events.MouseDown), events.Paste("x")])
def test_nothing_is_merged_across_keys_clicks_and_pastes(between: Message) -> None:
    first, last = moved(1), moved(2)
    assert merge_all(first, between, last) == [first, between, last]


def test_only_the_last_wheel_steps_are_kept() -> None:
    up = wheel(events.MouseScrollUp)
    waiting = merge_all(*(wheel() for _ in range(100)), up)
    assert len(waiting) == MAX_WHEEL_STEPS and waiting[-1] is up


def test_app_gets_more_input_after_handling_the_previous() -> None:
    loop, app = Loop(), App()
    queue = InputQueue(app, loop)  # type: ignore[arg-type] # as far as it is used
    assert queue.is_idle
    first, last, key = moved(1), moved(500), events.Key("x", "x")
    queue.put(first)
    loop.due.popleft()()
    for x in range(2, 500):
        queue.put(moved(x))
    queue.put(last)
    queue.put(key)
    assert not loop.due and not queue.is_idle
    assert app.handle() == [first, last, key]
    assert queue.is_idle
    queue.put(key)
    loop.due.popleft()()
    assert app.handle() == [key]


def test_resize_signals_are_merged() -> None:
    loop, app = Loop(), App()
    queue = InputQueue(app, loop)  # type: ignore[arg-type] # as above
    sizes = iter((resized(81), resized(82)))
    for _ in range(300):
        queue.resized(lambda: next(sizes))
    while loop.due:
        loop.due.popleft()()
    (event,) = app.handle()
    assert isinstance(event, events.Resize) and event.size.width == 81


def test_queue_of_an_ended_app_does_not_fail() -> None:
    loop, app = Loop(), App()
    app.closed = True
    queue = InputQueue(app, loop)  # type: ignore[arg-type] # as above
    queue.put(moved(1))
    for _ in range(5):
        if loop.due:
            loop.due.popleft()()
    assert queue.is_idle
