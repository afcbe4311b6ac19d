"""The events just before a log line: parameter changes and launch events, newest first."""

from __future__ import annotations

import heapq
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from bot_console.tui.console.model import Change, LaunchEvent
from bot_console.tui.text.refusals import verdict_of_change
from bot_console.tui.text.value_text import value_text
from bot_console.tui.widgets.prompt.question import Option

MAX_EVENTS = 20
HISTORY, LAUNCH = "history", "launch"


@dataclass(frozen=True)
class PrecedingEvent:
    """An event, and the pane with its details."""

    stamp: int
    text: str
    pane: str


def preceding_events(stamp: int, changes: Iterable[Change], events: Iterable[LaunchEvent]) -> list[PrecedingEvent]:
    """The last events up to a moment (ns since the epoch), newest first."""
    known = [
        *(PrecedingEvent(each.stamp, _change_text(each), HISTORY) for each in changes if each.stamp <= stamp),
        *(PrecedingEvent(each.stamp, f"launch: {each.text}", LAUNCH) for each in events if each.stamp <= stamp),
    ]
    return heapq.nlargest(MAX_EVENTS, known, key=lambda each: each.stamp)


def options_of(found: Sequence[PrecedingEvent], stamp: int, typed: str) -> list[Option]:
    """The events that contain what was typed, each with its time before the moment."""
    words = typed.lower().split()
    return [
        Option(each.text, f"{_ago(stamp - each.stamp)} before · {each.pane}", str(index))
        for index, each in enumerate(found)
        if all(word in each.text.lower() for word in words)
    ]


def _change_text(change: Change) -> str:
    verdict = verdict_of_change(change)
    verb = f", {verdict}: {change.reason}" if verdict else ""
    return f"{change.node} {change.name}: {value_text(change.old)} → {value_text(change.new)}{verb}"


def _ago(duration: int) -> str:
    seconds = duration / 1e9
    if seconds < 10:
        return f"{seconds:.2f} s"
    if seconds < 120:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 7200 else f"{seconds / 3600:.0f} h"
