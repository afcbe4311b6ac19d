"""Fork the server from its parent: that starts no new interpreter, and shares the modules the parent has imported."""

from __future__ import annotations

import atexit
import contextlib
import os
import signal
import subprocess
import sys
import threading
import time
import traceback
from collections.abc import Callable
from types import ModuleType
from typing import NoReturn

from .shown_command import show_command

NAME = "bot-console fork server"
"""The name shown by system tools."""
DESCRIPTORS = "/dev/fd"
"""The folder that lists the open descriptors of a process on Linux and macOS."""


def has_one_thread() -> bool:
    """Whether this process may be forked and continue in both: a fork has only the thread that forked."""
    alone = threading.active_count() == 1 and threading.current_thread() is threading.main_thread()
    try:
        return alone and len(os.listdir("/proc/self/task")) == 1  # libraries may have threads that Python does not know
    except OSError:
        return alone


class Fork:
    """A fork of this process, with the part of the interface of `subprocess.Popen` that is needed here. Thread-safe."""

    def __init__(self, serve: Callable[[], object], kept: int) -> None:
        """Fork a child that calls `serve()` and exits. It inherits only its output and the descriptor `kept`."""
        for stream in (sys.stdout, sys.stderr):
            if stream is not None:  # None if the descriptor is closed
                # the remaining content of its buffer would be written twice
                with contextlib.suppress(OSError, ValueError):
                    stream.flush()
        self._lock = threading.Lock()
        self.returncode: int | None = None
        # Ctrl-C is for the parent, and the fork has no handler for it before `setsid`.
        before = signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
        self.pid = os.fork()
        if self.pid == 0:
            _run_fork(serve, kept, before)
        signal.pthread_sigmask(signal.SIG_SETMASK, before)

    def poll(self) -> int | None:
        """Return the exit code; None while the fork runs."""
        with self._lock:
            if self.returncode is None:
                try:
                    pid, status = os.waitpid(self.pid, os.WNOHANG)
                except ChildProcessError:  # another thread has waited for every child
                    self.returncode = 0
                else:
                    self.returncode = os.waitstatus_to_exitcode(status) if pid else None
            return self.returncode

    def wait(self, timeout: float | None = None) -> int:
        """Wait for the fork to end; raises `subprocess.TimeoutExpired` after `timeout` (s)."""
        deadline, pause = time.monotonic() + (float("inf") if timeout is None else timeout), 0.0005
        while (code := self.poll()) is None:
            left = deadline - time.monotonic()
            if left <= 0:
                raise subprocess.TimeoutExpired("fork server", timeout or 0.0)
            pause = min(pause * 2, left, 0.05)
            time.sleep(pause)
        return code

    def kill(self) -> None:
        """Kill the fork, unless it has ended."""
        if self.poll() is None:
            os.kill(self.pid, signal.SIGKILL)


def _run_fork(serve: Callable[[], object], kept: int, signals: set[signal.Signals] | set[int]) -> NoReturn:
    """In the fork: discard what belongs to the parent's program, and serve."""
    code = 1
    try:
        os.setsid()
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # until the server runs; discards one sent before `setsid`
        signal.pthread_sigmask(signal.SIG_SETMASK, signals)
        _close_all_but(kept)
        _forget_the_program()
        show_command(NAME.split())
        serve()
        code = 0
    except BaseException:  # control must never return to the parent's program
        traceback.print_exc()
    finally:
        os._exit(code)


def _close_all_but(kept: int) -> None:
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    for name in os.listdir(DESCRIPTORS):
        if int(name) > 2 and int(name) != kept:
            with contextlib.suppress(OSError):  # the descriptor of the listing itself
                os.close(int(name))


def _forget_the_program() -> None:
    """Make the children's programs independent of the parent's: its exit functions, and the modules beside its file."""
    atexit._clear()  # pyright: ignore[reportPrivateUsage] -- has no other name
    sys.modules["__main__"] = ModuleType("__main__")  # else `multiprocessing` imports the parent's again
    beside = ("", os.getcwd(), os.path.dirname(os.path.realpath(sys.argv[0])))
    if sys.path and sys.path[0] in beside and not getattr(sys.flags, "safe_path", sys.flags.isolated):
        sys.path.pop(0)
