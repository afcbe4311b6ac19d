"""Name the line that a thread is executing from a user's point of view; trim tracebacks to the user's frames."""

from __future__ import annotations

import os
import sys
from types import FrameType, TracebackType

_PROCESS = os.path.dirname(os.path.abspath(__file__)) + os.sep
_RUNTIME = os.path.dirname(_PROCESS.rstrip(os.sep)) + os.sep
# ROS names are imported through links, whose targets are elsewhere in an editable installation.
_OURS = (_RUNTIME, os.path.realpath(_RUNTIME) + os.sep)
_SHIPPED = tuple(os.path.dirname(each.rstrip(os.sep)) + os.sep for each in _OURS)
_STDLIB = os.path.dirname(os.path.realpath(os.__file__)) + os.sep
_WAITS = ("threading.py", "selectors.py", "queue.py", "socket.py", "subprocess.py", "concurrent/futures/thread.py")
_SITE = ("site-packages", "dist-packages")


def is_library(filename: str) -> bool:
    """Whether a file belongs to the interpreter, an installed library or the runtime, where a user would not look."""
    if filename.startswith(("<frozen", *_OURS)):
        return True
    # A wheel puts our own nodes into site-packages, and a clone may contain an environment with its own site-packages.
    inside = next((filename[len(each) :] for each in _SHIPPED if filename.startswith(each)), filename)
    return any(part in inside for part in _SITE) or os.path.realpath(filename).startswith(_STDLIB)


def is_idle(filename: str) -> bool:
    """Whether a thread whose innermost frame is in this file is waiting: in the runtime or in the standard library."""
    return filename.startswith(_OURS) or os.path.realpath(filename).removeprefix(_STDLIB) in _WAITS


def is_shipped(filename: str) -> bool:
    """Whether a file is part of this program, like its own nodes."""
    return filename.startswith(_SHIPPED)


def user_frame(frame: FrameType) -> FrameType:
    """Return the innermost frame of the user's own code on this stack; without such a frame, the innermost of all."""
    candidate: FrameType | None = frame
    while candidate is not None:
        if not is_library(candidate.f_code.co_filename):
            return candidate
        candidate = candidate.f_back
    return frame


def describe(frame: FrameType) -> str:
    """Format a frame as `/path/file.py:12, in function`."""
    return f"{frame.f_code.co_filename}:{frame.f_lineno}, in {frame.f_code.co_name}"


def line_outside(frame: FrameType | None) -> str:
    """Return `/path/file.py:12` of the innermost frame outside the runtime, even in a library; empty if none."""
    while frame is not None and frame.f_code.co_filename.startswith((*_OURS, "<frozen")):
        frame = frame.f_back
    return f"{frame.f_code.co_filename}:{frame.f_lineno}" if frame is not None else ""


def thread_line(ident: int) -> str | None:
    """Return the line of the user's code that a thread is executing; None if the thread has ended."""
    frame = sys._current_frames().get(ident)  # pyright: ignore[reportPrivateUsage] -- documented in `sys`
    return None if frame is None else describe(user_frame(frame))


def is_importing(ident: int) -> bool:
    """Whether a thread is in the import machinery, or in a library's module that is being imported."""
    frame = sys._current_frames().get(ident)  # pyright: ignore[reportPrivateUsage] -- documented in `sys`
    while frame is not None and is_library(frame.f_code.co_filename):
        if frame.f_code.co_filename.startswith("<frozen importlib"):
            return True
        frame = frame.f_back
    return False


def _is_ours(frame: FrameType) -> bool:
    return frame.f_code.co_filename.startswith((_PROCESS, "<frozen importlib", "<frozen runpy"))


def trim_traceback(trace: TracebackType | None) -> TracebackType | None:
    """Return a traceback without the frames of this package and of the import machinery."""
    kept: TracebackType | None = None
    entries: list[TracebackType] = []
    while trace is not None:
        entries.append(trace)
        trace = trace.tb_next
    for entry in reversed(entries):
        if not _is_ours(entry.tb_frame):
            kept = TracebackType(kept, entry.tb_frame, entry.tb_lasti, entry.tb_lineno)
    return kept


def trim(exception: BaseException) -> BaseException:
    """Trim the tracebacks of an exception and of its causes and contexts; return the same exception."""
    seen: set[int] = set()
    queue: list[BaseException | None] = [exception]
    while queue:
        item = queue.pop()
        if item is None or id(item) in seen:
            continue
        seen.add(id(item))
        item.__traceback__ = trim_traceback(item.__traceback__)
        queue += [item.__cause__, item.__context__]
    return exception


def format_exception(exception: BaseException) -> str:
    """Return the interpreter's text for an uncaught exception, for a process that prints to `sys.stderr`."""
    if sys.version_info < (3, 12) and isinstance(exception, (AttributeError, NameError)):
        # Before Python 3.12 only the interpreter's own hook adds `Did you mean`.
        from contextlib import redirect_stderr
        from io import StringIO

        with redirect_stderr(StringIO()) as printed:
            sys.__excepthook__(type(exception), exception, exception.__traceback__)
        return printed.getvalue()
    import traceback

    return "".join(traceback.format_exception(exception))


def print_exception(exception: BaseException) -> None:
    """Print an uncaught exception as the interpreter does, to the calling thread's `sys.stderr`."""
    trim(exception)
    hook = sys.excepthook
    if hook is sys.__excepthook__ and sys.stderr is not sys.__stderr__:
        # The interpreter's own hook writes to the stream of the real process.
        import traceback

        traceback.print_exception(type(exception), exception, exception.__traceback__)
    else:
        hook(type(exception), exception, exception.__traceback__)
