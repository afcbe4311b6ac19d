"""What the tasks of an event loop wait for, as text: an app can stand while none of its threads does."""

from __future__ import annotations

import asyncio
from typing import Any


def waiting_tasks() -> str:
    """Each task of the loop that runs in this thread, with the lines in which it waits, the outermost first.

    Empty where none runs.
    """
    try:
        tasks = asyncio.all_tasks()
    except RuntimeError:
        return ""
    return "\n".join(sorted(f"Task {each.get_name()}:\n" + "".join(_lines(each.get_coro())) for each in tasks))


def _lines(waiting: Any) -> list[str]:
    found: list[str] = []
    while waiting is not None:
        frame = getattr(waiting, "cr_frame", None) or getattr(waiting, "gi_frame", None)
        if frame is not None:
            found.append(f'  File "{frame.f_code.co_filename}", line {frame.f_lineno} in {frame.f_code.co_name}\n')
        waiting = getattr(waiting, "cr_await", None) or getattr(waiting, "gi_yieldfrom", None)
    return found
