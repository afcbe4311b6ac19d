"""What a node process knows about itself and no topic tells, as plain data for whoever started it.

A process of its own writes to its data pipe; a node process that is a thread calls hooks of this process.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from . import data_pipe

Hook = Callable[[str, Mapping[str, Any]], object]
_hooks: list[Hook] = []


def on_fact(hook: Hook) -> Callable[[], None]:
    """Have facts given to `hook(kind, facts)`, from any thread; it must not block. Returns what ends that."""
    _hooks.append(hook)

    def forget() -> None:
        if hook in _hooks:
            _hooks.remove(hook)

    return forget


def anybody_listens() -> bool:
    """Whether it is worth while to work a fact out."""
    return bool(_hooks) or data_pipe.is_open()


def tell_fact(kind: str, **facts: Any) -> None:
    """Tell a fact of plain values; never waits."""
    data_pipe.tell(kind, **facts)
    for hook in tuple(_hooks):
        hook(kind, facts)
