"""End a process that runs a program, in the interpreter's own order and with its exit codes.

The interpreter itself is not finalized: foreign threads (of a middleware) may call back at any time, and would print a
panic after the program's output if they found it half torn down.
"""

from __future__ import annotations

import contextlib
import os
import signal
import sys
from collections.abc import Callable
from typing import NoReturn

from ..crashes import explanation
from ..current import MAIN
from ..ending import run_exit_functions, wait_for_threads
from ..notices import notify


def run_to_end(program: Callable[[], object]) -> NoReturn:
    """Run a program, wait for its threads, call its exit functions, and end the process."""
    code = _run(program)
    wait_for_threads()
    code = run_exit_functions(code)
    _flush_of_c()
    if code == -signal.SIGINT:  # so that the parent sees the signal as the cause of the exit
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        os.kill(os.getpid(), signal.SIGINT)
    os._exit(code & 0xFF)


def _run(program: Callable[[], object]) -> int:
    try:
        program()
    except SystemExit as end:
        if cause := explanation(end):
            notify(MAIN, cause)
        if end.code is None or isinstance(end.code, int):
            return end.code or 0
        print(end.code, file=sys.stderr)
        return 1
    except BaseException as error:
        try:
            sys.excepthook(type(error), error, error.__traceback__)
        except BaseException:  # the program's own hook
            sys.__excepthook__(type(error), error, error.__traceback__)
        return -signal.SIGINT if isinstance(error, KeyboardInterrupt) else 1
    return 0


def _flush_of_c() -> None:
    """Flush the stdio buffers of C libraries."""
    import ctypes

    with contextlib.suppress(OSError, AttributeError):
        ctypes.CDLL(None).fflush(None)
