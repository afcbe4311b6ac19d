"""What the tasks of an event loop are waiting for, as text: an app can hang although none of its threads does."""

from __future__ import annotations

import asyncio
from typing import Any


def waiting_tasks() -> str:
    """The tasks of the running event loop, with the lines where they wait, outermost first.

    Tasks that wait in the same place are grouped. Empty if no loop is running in this thread.
    """
    try:
        tasks = asyncio.all_tasks()
    except RuntimeError:
        return ""
    names: dict[str, list[str]] = {}
    for each in tasks:
        names.setdefault("".join(_lines(each.get_coro())), []).append(each.get_name())
    return "\n".join(f"Task {', '.join(sorted(alike))}:\n{lines}" for lines, alike in sorted(names.items()))


def _lines(waiting: Any) -> list[str]:
    found: list[str] = []
    while waiting is not None:
        frame = getattr(waiting, "cr_frame", None) or getattr(waiting, "gi_frame", None)
        if frame is not None:
            found.append(f'  File "{frame.f_code.co_filename}", line {frame.f_lineno} in {frame.f_code.co_name}\n')
        waiting = getattr(waiting, "cr_await", None) or getattr(waiting, "gi_yieldfrom", None)
    return found
