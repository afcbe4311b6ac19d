"""What a node process cannot have, or does to its neighbours: one message each, with file and line."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .roles import Warned

NoticeHook = Callable[["Warned", str], None]
_hooks: list[NoticeHook] = []


def on_notice(hook: NoticeHook) -> Callable[[], None]:
    """Have notices given to `hook(process, text)`, from any thread; it must not block. Returns what ends that.

    Without a hook a notice goes to the standard error stream of its process.
    """
    _hooks.append(hook)

    def forget() -> None:
        if hook in _hooks:
            _hooks.remove(hook)

    return forget


def notify(process: Warned, text: str) -> None:
    """Give a notice, once per process and text."""
    if text in process.notices:
        return
    process.notices.append(text)
    for hook in tuple(_hooks):
        hook(process, text)
    if not _hooks:
        stream = process.stderr or sys.__stderr__
        if stream is not None:
            stream.write(f"[WARN] [{process.name}]: {text}\n")
