"""Turn a fork of the server into a separate process that runs a program."""

from __future__ import annotations

import os
import random
import signal
import sys
import threading
import time
import traceback
from collections.abc import Callable, Sequence
from types import TracebackType
from typing import TextIO

from .. import data_pipe
from ..crashes import explanation
from ..current import MAIN
from ..notices import notify, on_notice
from ..stack_frames import format_exception, trim
from ..watch.busy_main_thread import MainWatch
from ..watch.gil_watch import GilWatch
from .job import function_named
from .server import HELD_BACK, NewChild
from .shown_command import show_command

LAST_PRIORITY = 500
"""OOM score adjustment (-1000 to 1000), so that the system kills this process before the console."""


def become(child: NewChild) -> Callable[[], object]:
    """Make this fork the process that a job describes and return its program. Signals are still blocked."""
    job = child.job
    os.setsid()
    _take_streams(child.stdio)
    data_pipe.use(child.data)
    os.chdir(job.cwd)
    os.environ.clear()
    os.environ.update(job.env)
    time.tzset()  # the time zone was read from the server's environment
    _add_python_path(job.env.get("PYTHONPATH", ""))
    sys.argv = MAIN.argv = list(job.argv)
    MAIN.name = job.name
    MAIN.pid = os.getpid()
    MAIN.locals.clear()
    MAIN.notices.clear()
    _name(job.name)
    show_command(job.argv)
    random.seed()
    if "numpy.random" in sys.modules:  # otherwise it seeds itself on import, which takes as long as all the rest
        sys.modules["numpy.random"].seed()
    sys.excepthook = _uncaught
    on_notice(lambda process, text: data_pipe.report("notice", text=text))
    MainWatch(lambda text: notify(MAIN, text)).begin()
    GilWatch(lambda ident, text: notify(MAIN, text)).begin()
    return function_named(job.program)(*job.arguments)


def let_signals_in() -> None:
    """Install the default handlers and unblock the signals; those received meanwhile are delivered."""
    for each in HELD_BACK:
        signal.signal(each, signal.default_int_handler if each == signal.SIGINT else signal.SIG_DFL)
    try:
        signal.pthread_sigmask(signal.SIG_UNBLOCK, HELD_BACK)
    except KeyboardInterrupt as interrupt:
        raise interrupt.with_traceback(None) from None  # the signal arrived before the program's first line


def _take_streams(stdio: Sequence[int]) -> None:
    for number, each in enumerate(stdio):
        os.dup2(each, number)
        os.close(each)
    sys.stdin = sys.__stdin__ = os.fdopen(0, closefd=False, encoding="utf-8")
    sys.stdout = sys.__stdout__ = _output(1, "surrogateescape")
    sys.stderr = sys.__stderr__ = _output(2, "backslashreplace")


def _output(descriptor: int, errors: str) -> TextIO:
    """Open a line-buffered stream although it is not a terminal, so that a log shows lines when they are printed."""
    return os.fdopen(descriptor, "w", buffering=1, closefd=False, encoding="utf-8", errors=errors)


def _add_python_path(folders: str) -> None:
    """Add the folders of PYTHONPATH to `sys.path`, as the interpreter does at start."""
    wanted = [os.path.abspath(each) for each in folders.split(os.pathsep) if each]
    sys.path[:0] = [each for each in wanted if each not in sys.path]


def _name(name: str) -> None:
    for file, text in (("comm", name[:15]), ("oom_score_adj", str(LAST_PRIORITY))):
        try:
            with open(f"/proc/self/{file}", "w") as writable:
                writable.write(text)
        except OSError:  # not supported or not permitted by this system
            continue


def _uncaught(kind: type[BaseException], exception: BaseException, trace: TracebackType | None) -> None:
    """Print an uncaught exception as the interpreter does, from the program's first line on; report it."""
    trim(exception.with_traceback(trace))
    text = format_exception(exception)
    sys.stderr.write(text)
    frames = traceback.extract_tb(exception.__traceback__)
    where = [(each.filename, each.lineno, each.name) for each in frames]
    data_pipe.report("uncaught", text=text, frames=where)
    if threading.current_thread() is threading.main_thread() and (cause := explanation(exception)):
        notify(MAIN, cause)
