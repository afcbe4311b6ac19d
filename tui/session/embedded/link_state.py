"""The state of the link to a robot's router for the status line: its delay, and how long it has been silent."""

from __future__ import annotations

import time

from bot_console.runtime.rmw.zenoh.link_probe import LinkState
from bot_console.runtime.rmw.zenoh.network.network_bus import NetworkBuses
from bot_console.tui.console.model import LinkInfo

NO_ANSWER_AFTER_S = 1
"""Seconds without a response from which on the status line counts them."""


class LinkStatus:
    """The state of the link in steps that are worth drawing."""

    def __init__(self, buses: NetworkBuses) -> None:
        self._buses = buses
        self._info = LinkInfo()

    def info(self) -> LinkInfo:
        """The state of the link; the same object until it changes."""
        info = link_info(self._buses.link(), time.monotonic())
        if info != self._info:
            self._info = info
        return self._info


def link_info(state: LinkState, now: float) -> LinkInfo:
    """The state of the link at a monotonic time (s); delays above 20 ms are rounded to 10 ms so that the display is
    calm.
    """
    silent_s = 0.0 if state.last_answer is None else now - state.last_answer
    delay = None if state.delay is None else max(1, round(state.delay * 1000))
    if delay is not None and delay > 20:
        delay = round(delay, -1)
    return LinkInfo(state.to, delay, int(silent_s) if silent_s >= NO_ANSWER_AFTER_S else 0, state.lost)
