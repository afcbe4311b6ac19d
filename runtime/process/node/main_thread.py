"""The main thread of a node process: from its target's first line to its exit code."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable
from typing import TYPE_CHECKING

from ..crashes import explanation
from ..notices import notify
from ..stack_frames import print_exception
from ..virtual import child_threads
from .thread_state import ProcessKilled, local

if TYPE_CHECKING:
    from ..roles import CurrentProcess

SIGINT_EXIT = -2


def start_main_thread(process: CurrentProcess, target: Callable[[], object]) -> None:
    """Start the thread that runs `target` as the main program of the process."""
    thread = threading.Thread(target=_Main(process, target), name="MainThread", daemon=False)
    child_threads.start_inside(process, process.clock, thread, child=False)


class _Main:
    """The callable that the thread runs."""

    def __init__(self, process: CurrentProcess, target: Callable[[], object]) -> None:
        self._process = process
        self._target: Callable[[], object] | None = target

    def __call__(self) -> None:
        # The program's objects are released when the program ends, not with the thread object, which others may keep.
        target, self._target = self._target, None
        assert target is not None
        try:
            code = exit_code_of(target)
        except BaseException:  # an interrupt while the last output is written
            code = SIGINT_EXIT
        if local.state is not None:
            local.state.ending = True
        if self._process.is_alive:
            self._wind_down()
            self._process.finish(code)
            self._end_children()

    def _wind_down(self) -> None:
        """Do what the interpreter does after the main program: wait for threads."""
        for pool in list(self._process.pools):
            pool.shutdown(wait=False)
        try:
            while waited_for := [t for t, s in self._process.children.items() if not s.daemon and t.is_alive()]:
                waited_for[0].join()
        except BaseException as exception:  # a second Ctrl-C ends only this wait
            if not isinstance(exception, ProcessKilled):
                print_exception(exception)

    def _end_children(self) -> None:
        """Kill the remaining daemon threads."""
        states = [state for state in self._process.children.values() if state.thread.is_alive()]
        for state in states:
            state.kill()
        if states:
            self._process.break_off_later(states)


def exit_code_of(target: Callable[[], object]) -> int:
    """Run a callable and return the exit code that a Python process would have; tracebacks go to its standard error."""
    try:
        target()
    except SystemExit as exception:
        if text := explanation(exception):
            notify(local.process, text)
        return _system_exit(exception)
    except ProcessKilled:
        return -9
    except KeyboardInterrupt as exception:
        print_exception(exception)
        return SIGINT_EXIT
    except BaseException as exception:  # the boundary of the process
        print_exception(exception)
        if text := explanation(exception):
            notify(local.process, text)
        return 1
    return 0


def _system_exit(exception: SystemExit) -> int:
    if exception.code is None:
        return 0
    if isinstance(exception.code, int):
        return exception.code & 0xFF
    print(exception.code, file=sys.stderr)
    return 1
