"""Notices about what a node process cannot do, or does to other processes: one message each, with file and line."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .roles import Warned

NoticeHook = Callable[["Warned", str], None]
STDERR = 2
"""The descriptor of the real standard error stream."""
_hooks: list[NoticeHook] = []


def on_notice(hook: NoticeHook) -> Callable[[], None]:
    """Register `hook(process, text)`, called from any thread; it must not block. Returns a function that removes it.

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
        line = f"[WARN] [{process.name}]: {text}\n"
        if process.stderr is not None:
            process.stderr.write(line)
        else:
            # Not `sys.__stderr__`, which is the screen while a console runs: the line would corrupt the display.
            with contextlib.suppress(OSError):
                os.write(STDERR, line.encode("utf-8", "backslashreplace"))
