"""An asyncio event loop in stepped time: its timers are virtual, and other threads run while it waits."""

from __future__ import annotations

import asyncio
import selectors
from asyncio.selector_events import BaseSelectorEventLoop
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from ..current import current
from ..node.thread_state import local

if TYPE_CHECKING:
    from ..clock_source import ClockSource, Wakeup


class SteppedEventLoop(asyncio.SelectorEventLoop):
    """An event loop for a thread that takes part in a stepped run.

    Files and sockets are polled on every iteration but do not wake the loop: virtual time does not wait for events
    outside the run.
    """

    def __init__(self, clock: ClockSource) -> None:
        self._stepped_clock = clock
        self._called = clock.wakeup()
        super().__init__(_SteppedSelector(clock, self._called))

    def time(self) -> float:
        """Virtual steady time in s."""
        return self._stepped_clock.steady_ns() * 1e-9

    def call_soon_threadsafe(self, callback: Callable[..., Any], *args: Any, context: Any = None) -> asyncio.Handle:
        """Call `callback` in the loop, which is woken; thread-safe."""
        handle = super().call_soon_threadsafe(callback, *args, context=context)
        self._called.set()
        return handle


class _SteppedSelector(selectors.DefaultSelector):
    def __init__(self, clock: ClockSource, called: Wakeup) -> None:
        super().__init__()
        self._clock = clock
        self._called = called

    def wake(self) -> None:
        """End the current wait; thread-safe."""
        self._called.set()

    def select(self, timeout: float | None = None) -> list[tuple[selectors.SelectorKey, int]]:
        """Return what is ready now, or after a virtual wait of at most `timeout` s."""
        events = super().select(0)
        if not events and (timeout is None or timeout > 0):
            deadline = None if timeout is None else self._clock.steady_ns() + round(timeout * 1e9)
            self._called.wait(deadline)
            events = super().select(0)
        self._called.clear()
        return events


def new_event_loop() -> asyncio.AbstractEventLoop:
    """Return an event loop in the time of the calling thread's node process."""
    clock = current().clock
    return SteppedEventLoop(clock) if clock.stepped else asyncio.new_event_loop()


def wraps() -> list[tuple[Any, str, Any]]:
    """Return owner, name and replacement of the calls that make all event loops of stepped threads stepped."""
    real_init: Any = BaseSelectorEventLoop.__init__
    real_write: Any = getattr(BaseSelectorEventLoop, "_write_to_self")  # noqa: B009 -- private, yet all calls of other threads end there

    def init(loop: Any, selector: Any = None) -> None:
        clock = local.waits_on
        if selector is None and clock is not None:
            selector = _SteppedSelector(clock, clock.wakeup())
        real_init(loop, selector)

    def write_to_self(loop: Any) -> None:
        real_write(loop)
        if isinstance(loop._selector, _SteppedSelector):
            loop._selector.wake()

    return [(BaseSelectorEventLoop, "__init__", init), (BaseSelectorEventLoop, "_write_to_self", write_to_self)]
