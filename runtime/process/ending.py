"""End a process without finalizing its interpreter: calls from foreign threads would find it half torn down."""

from __future__ import annotations

import atexit
import contextlib
import sys
import threading

from .current import MAIN

FLUSH_FAILED = 120
"""Exit code of the interpreter if its last output could not be written."""


def wait_for_threads() -> None:
    """Wait for non-daemon threads and executors, as the interpreter does at exit; Ctrl-C ends the wait."""
    with contextlib.suppress(KeyboardInterrupt):
        threading._shutdown()  # pyright: ignore[reportAttributeAccessIssue, reportUnknownMemberType] -- has no other name
        # In a stepped run all threads are daemons to the interpreter, which would wait for them without giving them a
        # turn.
        while left := [each for each, state in MAIN.children.items() if not state.daemon and each.is_alive()]:
            left[0].join()


def run_exit_functions(code: int) -> int:
    """Call the exit functions and flush the output streams, as the interpreter does at exit. The caller must then call
    `os._exit`.

    Returns the exit code: `code`, or `FLUSH_FAILED` if output could not be written.
    """
    atexit._run_exitfuncs()  # pyright: ignore[reportPrivateUsage] -- the only way before `os._exit`
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except (AttributeError, OSError, ValueError):  # None, closed, or without a reader
            code = code if stream is None or getattr(stream, "closed", False) else FLUSH_FAILED
    return code
