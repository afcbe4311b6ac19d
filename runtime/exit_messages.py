"""How a command ends that cannot go on: one-line messages for faults of its environment, silence after an interrupt."""

from __future__ import annotations

import errno
import io
import os
import signal
import sys
from collections.abc import Callable
from typing import Any

DELETED = "the folder you are in was deleted; go to another one (cd) and try again"
RECOGNIZED = 60
"""Characters of a name that are shown where it is too long."""
ENDED = "ExternalShutdownException"
"""What a wait raises when SIGTERM has ended the context; named, as not every command imports rclpy."""
NO_THREAD = "can't start new thread"
"""How Python puts that in a RuntimeError."""
UNMAPPED = "failed to map segment"
"""How a library that does not fit into memory is put in an ImportError."""
NO_TEMPORARY = "No usable temporary directory"
"""How Python puts that in a FileNotFoundError."""
RAISING = ("strict", "surrogateescape")
"""Ways of a stream to treat characters that it cannot encode that raise; the second is that of the C locale."""
FULL = (errno.ENOSPC, errno.EDQUOT, errno.EIO, errno.EFBIG)


def place_fault(error: BaseException) -> str:
    """What to say of an error that names no file: of standard output, or of the working directory; else empty.

    Of a file whose name is too long it is said, too: it is not even looked for. So it is of limits of this process.
    """
    if isinstance(error, SystemError) and not _has_folder():  # so says an import of Python 3.13.0 there
        return DELETED
    unloaded = isinstance(error, ImportError) and UNMAPPED in str(error)
    if unloaded or isinstance(error, MemoryError) or (isinstance(error, OSError) and error.errno == errno.ENOMEM):
        return "there is too little memory (a limit is shown by `ulimit -v`)"
    if isinstance(error, RuntimeError) and str(error) == NO_THREAD:
        return "no more threads can be started (limits are shown by `ulimit -v` and `ulimit -u`)"
    if isinstance(error, OSError) and error.errno == errno.EMFILE:
        return "too many files are open (the limit is shown by `ulimit -n`)"
    if isinstance(error, OSError) and error.errno == errno.ENAMETOOLONG:
        return f"{_shortened(error.filename)} cannot be a file: its name is too long"
    if not isinstance(error, OSError) or error.filename is not None:
        return ""
    if NO_TEMPORARY in str(error):
        return "no temporary file can be written: the disk is full, or the size of files is limited (`ulimit -f`)"
    if error.errno in FULL:
        return f"the output cannot be written: {error.strerror}"
    if error.errno == errno.ENOENT and not _has_folder():
        return DELETED
    return ""


def _shortened(name: object) -> str:
    """The beginning of a name, quoted, as much of it as one recognizes it by."""
    text = os.fsdecode(name) if isinstance(name, (str, bytes)) else "what was given"
    return repr(text if len(text) <= RECOGNIZED else f"{text[:RECOGNIZED]}...")


def _has_folder() -> bool:
    try:
        os.getcwd()
    except OSError:
        return False
    return True


def report_help_errors() -> None:
    """Let the help of every parser fail where it cannot be written: argparse would drop the fault, and end with 0."""
    import argparse

    def write(self: argparse.ArgumentParser, message: str, file: Any = None) -> None:
        if message:
            (file or sys.stderr).write(message)

    argparse.ArgumentParser._print_message = write  # pyright: ignore[reportPrivateUsage] -- where all help passes


def help_is_english() -> None:
    """Let parsers take their texts as they are: for each they would look for translations, of which Python has none.

    That is a thirtieth of a short verb's time.
    """
    import argparse

    argparse._ = str  # pyright: ignore[reportAttributeAccessIssue] -- what they ask for the translation of a text


def is_read() -> bool:
    """Whether stderr is a terminal: what is said beyond the words of ROS 2 is for people alone."""
    return sys.stderr is not None and sys.stderr.isatty()


def ended_code(error: BaseException) -> int:
    """The exit code that shells give to what this ended: Ctrl-C, or SIGTERM; 0 for any other error."""
    if isinstance(error, KeyboardInterrupt):
        return 128 + signal.SIGINT
    return 128 + signal.SIGTERM if type(error).__name__ == ENDED else 0


def run_and_report(run: Callable[[], int]) -> int:
    """Run a command and flush what it has printed; a fault of its place is told on one line, with exit code 1.

    What Ctrl-C or SIGTERM has ended has the exit code that shells give it.
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
    except BrokenPipeError:  # as of `head`, which has read enough
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
    if not code:  # else the command has told why
        print(f"{os.path.basename(sys.argv[0])}: {text}", file=sys.stderr)
    _give_up_output()
    return code or 1


def _make_streams_usable() -> None:
    """Open standard streams that were closed on nothing, and let no character fail that a terminal does not have.

    A descriptor of 0 to 2 that stays free is given to the next file or socket, which would then get what is printed.
    """
    for name, mode in (("stdin", "r"), ("stdout", "w"), ("stderr", "w")):
        stream = getattr(sys, name)
        if stream is None:
            # As the interpreter's own, it does not take its descriptor along: in a fork that has become that of a node.
            setattr(sys, name, os.fdopen(os.open(os.devnull, os.O_RDWR), mode, closefd=False))
        elif isinstance(stream, io.TextIOWrapper) and mode == "w" and stream.errors in RAISING:
            stream.reconfigure(errors="replace")


def _give_up_output() -> None:
    """What was not written is dropped, or it would fail once more at the end."""
    try:
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, sys.stdout.fileno())
        os.close(nowhere)
    except (OSError, ValueError):  # a stream without a descriptor
        return
