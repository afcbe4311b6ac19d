"""How a command that cannot continue ends: with a one-line message for a fault of its environment, silently after
Ctrl-C.
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
"""How many characters of a name that is too long are shown."""
ENDED = "ExternalShutdownException"
"""The exception that a wait raises when SIGTERM has ended the context; by name, as not every command imports rclpy."""
NO_THREAD = "can't start new thread"
"""Python's message in the RuntimeError for this."""
NO_DESCRIPTOR = f"(os error {errno.EMFILE})"
"""The end of Zenoh's message in the RuntimeError for this."""
UNMAPPED = "failed to map segment"
"""The message in the ImportError for a library that does not fit into memory."""
NO_TEMPORARY = "No usable temporary directory"
"""Python's message in the FileNotFoundError for this."""
RAISING = ("strict", "surrogateescape")
"""Error handlers of streams that raise for characters that cannot be encoded; the second is the C locale's."""
FULL = (errno.ENOSPC, errno.EDQUOT, errno.EIO, errno.EFBIG)


class Interrupted(int):
    """The exit code of a program ended by Ctrl-C, where a fault may have the same code: with `ros2`, 2."""


def place_fault(error: BaseException) -> str:
    """Return the message for an error that names no file, about standard output or the working directory; else empty.

    Also covers a file name that is too long, which fails before the lookup, and limits of this process.
    """
    if isinstance(error, SystemError) and not _has_folder():  # Python 3.13.0 raises it on import in a deleted folder
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
    """Return the message for an error caused, directly or indirectly, by a limit of this process or machine."""
    if error is None:
        return ""
    unloaded = isinstance(error, ImportError) and UNMAPPED in str(error)
    if unloaded or isinstance(error, MemoryError) or (isinstance(error, OSError) and error.errno == errno.ENOMEM):
        return "there is too little memory (a limit is shown by `ulimit -v`)"
    if isinstance(error, RuntimeError) and str(error) == NO_THREAD:
        return "no more threads can be started (limits are shown by `ulimit -v` and `ulimit -u`)"
    is_zenoh = isinstance(error, RuntimeError) and NO_DESCRIPTOR in str(error)
    if is_zenoh or (isinstance(error, OSError) and error.errno == errno.EMFILE):
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
    """Make printing a parser's help fail if it cannot be written: argparse would ignore the error and end with 0."""
    import argparse

    def write(self: argparse.ArgumentParser, message: str, file: Any = None) -> None:
        if message:
            (file or sys.stderr).write(message)

    argparse.ArgumentParser._print_message = write  # pyright: ignore[reportPrivateUsage] -- where all help passes


def help_is_english() -> None:
    """Make parsers use their texts unchanged instead of searching for translations, of which Python has none.

    That search takes a thirtieth of a short verb's time.
    """
    import argparse

    argparse._ = str  # pyright: ignore[reportAttributeAccessIssue] -- what they ask for the translation of a text


def stderr_is_terminal() -> bool:
    """Whether a person reads stderr: output beyond that of ROS 2 is only for people."""
    return sys.stderr is not None and sys.stderr.isatty()


def ended_code(error: BaseException) -> int:
    """Return the exit code that shells use for Ctrl-C or SIGTERM; 0 for any other error."""
    if isinstance(error, KeyboardInterrupt):
        return 128 + signal.SIGINT
    return 128 + signal.SIGTERM if type(error).__name__ == ENDED else 0


def run_and_report(run: Callable[[], int]) -> int:
    """Run a command and flush its output; a fault of its environment is reported in one line, with exit code 1.

    After Ctrl-C or SIGTERM, the exit code is the one that shells use.
    """
    code = 0
    _make_streams_usable()
    try:
        try:
            code = run()
        except SystemExit as end:  # as a parser does after its help
            code = end.code if isinstance(end.code, int) else 1 if end.code else 0
            if isinstance(end.code, str):
                print(end.code, file=sys.stderr)
        sys.stdout.flush()
        return code
    except BrokenPipeError:  # such as `head`, which has read enough
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
    if not code:  # otherwise the command has already said why
        print(f"{os.path.basename(sys.argv[0])}: {text}", file=sys.stderr)
    _give_up_output()
    return code or 1


def _make_streams_usable() -> None:
    """Open closed standard streams on the null device, and replace characters that a terminal cannot show.

    The next file or socket would get a free descriptor from 0 to 2, and then receive the output.
    """
    for name, mode in (("stdin", "r"), ("stdout", "w"), ("stderr", "w")):
        stream = getattr(sys, name)
        if stream is None:
            # Like the interpreter's own streams, it does not close its descriptor, which in a fork may by then belong
            # to a node.
            setattr(sys, name, os.fdopen(os.open(os.devnull, os.O_RDWR), mode, closefd=False))
        elif isinstance(stream, io.TextIOWrapper) and mode == "w" and stream.errors in RAISING:
            stream.reconfigure(errors="replace")


def _give_up_output() -> None:
    """Discard unwritten output, which would fail again at exit."""
    try:
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, sys.stdout.fileno())
        os.close(nowhere)
    except (OSError, ValueError):  # a stream without a descriptor
        return
