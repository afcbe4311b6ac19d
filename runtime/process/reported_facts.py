"""Facts that only a node process knows about itself, and no topic carries: plain data for the program that started it.

A separate process writes them to its data pipe; for a node process in a thread, hooks in this process are called.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from . import data_pipe

Hook = Callable[[str, Mapping[str, Any]], object]
_hooks: list[Hook] = []


def on_fact(hook: Hook) -> Callable[[], None]:
    """Register `hook(kind, facts)`, called from any thread; it must not block. Returns a function that removes it."""
    _hooks.append(hook)

    def forget() -> None:
        if hook in _hooks:
            _hooks.remove(hook)

    return forget


def anybody_listens() -> bool:
    """Whether anybody receives facts, so that it is worth computing them."""
    return bool(_hooks) or data_pipe.is_open()


def report_fact(kind: str, **facts: Any) -> None:
    """Publish a fact that consists of plain values; never blocks."""
    data_pipe.report(kind, **facts)
    for hook in tuple(_hooks):
        hook(kind, facts)
