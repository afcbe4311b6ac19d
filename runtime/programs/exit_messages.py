"""How a command that cannot continue ends: a one-line message for faults of its environment, silence after an
interrupt.
"""

from __future__ import annotations

import errno
import io
import os
import signal
import sys
from collections.abc import Callable
from typing import Any

DELETED = "the folder you are in was deleted; go to another one (cd) and try again"
MAX_NAME_CHARACTERS = 60
"""Characters shown of a name that is too long."""
ENDED = "ExternalShutdownException"
"""The exception raised by a wait when SIGTERM has ended the context; by name, as not every command imports rclpy."""
NO_THREAD = "can't start new thread"
"""Python's message for this in a RuntimeError."""
UNMAPPED = "failed to map segment"
"""The message in an ImportError for a library that does not fit into memory."""
NO_TEMPORARY = "No usable temporary directory"
"""Python's message for this in a FileNotFoundError."""
RAISING = ("strict", "surrogateescape")
"""Error handlers of streams that raise for characters they cannot encode; the second is that of the C locale."""
FULL = (errno.ENOSPC, errno.EDQUOT, errno.EIO, errno.EFBIG)


class Interrupted(int):
    """The exit code of a program that Ctrl-C has ended, where a fault has the same: of `ros2`, 2."""


def place_fault(error: BaseException) -> str:
    """Return the message for an error that names no file: of standard output, or the working directory; else empty.

    Also covers a file name that is too long, which fails before the lookup, and limits of this process.
    """
    if isinstance(error, SystemError) and not _has_folder():  # raised by an import of Python 3.13.0 in a deleted folder
        return DELETED
    if reached := limit_fault(error):
        return reached
    if isinstance(error, OSError) and error.errno == errno.ENAMETOOLONG:
        return f"{_shortened(error.filename)} cannot be a file: its name is too long"
    if not isinstance(error, OSError) or error.filename is not None:
        return ""
    if error.errno in FULL:
        return f"the output cannot be written: {error.strerror}"
    if error.errno == errno.ENOENT and not _has_folder():
        return DELETED
    return ""


def limit_fault(error: BaseException | None) -> str:
    """Return the message for an error raised by a limit of this process or machine, or by an error it caused."""
    if error is None:
        return ""
    unloaded = isinstance(error, ImportError) and UNMAPPED in str(error)
    if unloaded or isinstance(error, MemoryError) or (isinstance(error, OSError) and error.errno == errno.ENOMEM):
        return "there is too little memory (a limit is shown by `ulimit -v`)"
    if isinstance(error, RuntimeError) and str(error) == NO_THREAD:
        return "no more threads can be started (limits are shown by `ulimit -v` and `ulimit -u`)"
    if isinstance(error, OSError) and error.errno == errno.EMFILE:
        return "too many files are open (the limit is shown by `ulimit -n`)"
    if isinstance(error, OSError) and error.filename is None and NO_TEMPORARY in str(error):
        return "no temporary file can be written: the disk is full, or the size of files is limited (`ulimit -f`)"
    return limit_fault(error.__cause__)


def _shortened(name: object) -> str:
    """Return enough of the beginning of a name to recognize it, quoted."""
    text = os.fsdecode(name) if isinstance(name, (str, bytes)) else "what was given"
    return repr(text if len(text) <= MAX_NAME_CHARACTERS else f"{text[:MAX_NAME_CHARACTERS]}...")


def _has_folder() -> bool:
    try:
        os.getcwd()
    except OSError:
        return False
    return True


def report_help_errors() -> None:
    """Make the help of every parser fail if it cannot be written: argparse would ignore the error and end with 0."""
    import argparse

    def write(self: argparse.ArgumentParser, message: str, file: Any = None) -> None:
        if message:
            (file or sys.stderr).write(message)

    argparse.ArgumentParser._print_message = write  # pyright: ignore[reportPrivateUsage] -- where all help passes


def help_is_english() -> None:
    """Make parsers use their texts unchanged: they would search for translations, of which Python has none.

    That takes a thirtieth of a short verb's time.
    """
    import argparse

    argparse._ = str  # pyright: ignore[reportAttributeAccessIssue] -- what they ask for the translation of a text


def stderr_is_terminal() -> bool:
    """Whether a person reads stderr: anything beyond the output of ROS 2 is only for people."""
    return sys.stderr is not None and sys.stderr.isatty()


def ended_code(error: BaseException) -> int:
    """Return the exit code that shells use for Ctrl-C or SIGTERM; 0 for any other error."""
    if isinstance(error, KeyboardInterrupt):
        return 128 + signal.SIGINT
    return 128 + signal.SIGTERM if type(error).__name__ == ENDED else 0


def run_and_report(run: Callable[[], int]) -> int:
    """Run a command and flush its output; a fault of its environment is reported on one line, with exit code 1.

    After Ctrl-C or SIGTERM the exit code is the one that shells use.
    """
    code = 0
    _make_streams_usable()
    try:
        try:
            code = run()
        except SystemExit as end:  # as a parser ends after its help
            code = end.code if isinstance(end.code, int) else 1 if end.code else 0
            if isinstance(end.code, str):
                print(end.code, file=sys.stderr)
        sys.stdout.flush()
        return code
    except BrokenPipeError:  # as with `head`, which has read enough
        _give_up_output()
        return code or 1
    except (OSError, SystemError, RuntimeError, MemoryError, ImportError) as error:
        if code := ended_code(error):
            return code
        text = place_fault(error)
        if not text:
            raise
    except BaseException as error:
        if not (code := ended_code(error)):
            raise
        return code
    if not code:  # otherwise the command has said why
        print(f"{os.path.basename(sys.argv[0])}: {text}", file=sys.stderr)
    _give_up_output()
    return code or 1


def _make_streams_usable() -> None:
    """Open closed standard streams on the null device, and let no character fail that a terminal cannot show.

    A free descriptor from 0 to 2 would be given to the next file or socket, which would then receive the output.
    """
    for name, mode in (("stdin", "r"), ("stdout", "w"), ("stderr", "w")):
        stream = getattr(sys, name)
        if stream is None:
            # Like the interpreter's own streams, it does not close its descriptor: in a fork that may be a node's by
            # then.
            setattr(sys, name, os.fdopen(os.open(os.devnull, os.O_RDWR), mode, closefd=False))
        elif isinstance(stream, io.TextIOWrapper) and mode == "w" and stream.errors in RAISING:
            stream.reconfigure(errors="replace")


def _give_up_output() -> None:
    """Discard unwritten output, which would fail once more at exit."""
    try:
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, sys.stdout.fileno())
        os.close(nowhere)
    except (OSError, ValueError):  # a stream without a descriptor
        return
