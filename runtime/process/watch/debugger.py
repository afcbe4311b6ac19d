"""Detect that a thread of this process is stopped in a Python debugger: pdb and its kin, or debugpy."""

from __future__ import annotations

import os
import sys
from types import FrameType

from .. import stack_frames

_DEBUGGERS = frozenset(("bdb", "pydevd"))
"""Modules without which no debugger can have stopped a thread; pydevd is the part of debugpy that stops threads."""
_PYDEVD_WAITS = frozenset(("do_wait_suspend", "_do_wait_suspend"))


def line_in_debugger() -> str | None:
    """Return the line at which a thread is stopped, as `/path/file.py:12, in function`; None if none is stopped.

    It is empty if the debugger shows an exception that has already left the user's code.
    """
    if not _DEBUGGERS & sys.modules.keys():
        return None
    for innermost in sys._current_frames().values():  # pyright: ignore[reportPrivateUsage] -- documented in `sys`
        callee: FrameType | None = None
        frame: FrameType | None = innermost
        while frame is not None:
            if _is_interaction(frame, callee):
                stopped = stack_frames.user_frame(frame)
                return "" if stopped is frame else stack_frames.describe(stopped)
            callee, frame = frame, frame.f_back
    return None


def _is_interaction(frame: FrameType, callee: FrameType | None) -> bool:
    """Whether a debugger waits for its user in this frame: `callee` is the frame that it has called."""
    file, function = os.path.basename(frame.f_code.co_filename), frame.f_code.co_name
    if file == "bdb.py":  # pdb, ipdb, pudb etc. call `user_line` and the like only where they stop
        return callee is not None and callee.f_code.co_name.startswith("user_")
    if file == "pdb.py":
        return function == "interaction"
    return file == "pydevd.py" and function in _PYDEVD_WAITS
