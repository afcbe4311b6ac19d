"""Ends a process without finalizing its interpreter, which calls from other threads would find half torn down."""

from __future__ import annotations

import atexit
import contextlib
import sys
import threading

FLUSH_FAILED = 120
"""Exit code of the interpreter where its last output could not be written."""


def wait_for_threads() -> None:
    """Wait for threads that are no daemons and for executors, as the interpreter does; Ctrl-C ends the waiting."""
    with contextlib.suppress(KeyboardInterrupt):
        threading._shutdown()  # pyright: ignore[reportAttributeAccessIssue, reportUnknownMemberType] -- has no other name


def exit_functions_run(code: int) -> int:
    """Call the exit functions and write what was printed, as the interpreter does at its end; `os._exit` is left to do.

    Gives the exit code: `code`, or that of output which could not be written.
    """
    atexit._run_exitfuncs()  # pyright: ignore[reportPrivateUsage] -- the only way before `os._exit`
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except (AttributeError, OSError, ValueError):  # None, a reader that has gone, closed
            code = code if stream is None or getattr(stream, "closed", False) else FLUSH_FAILED
    return code
