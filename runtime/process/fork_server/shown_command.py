"""The command line of this process as shown by `ps` and `pkill -f`. Linux; elsewhere it stays that of the parent."""

from __future__ import annotations

from collections.abc import Sequence

START, END = 47, 48
"""Fields of `/proc/self/stat` (proc(5), from 0): start and end of the memory with the command line."""


def show_command(words: Sequence[str]) -> None:
    """Show other words from now on, cut off where those of the interpreter have ended.

    A fork has its parent's: a signal that a shell sends to all `ros2 launch` would reach the nodes as well, beside the
    one that the launch then sends them.
    """
    try:
        with open("/proc/self/stat", "rb") as stat, open("/proc/self/cmdline", "rb") as shown:
            # The second field may contain blanks and parentheses.
            fields = [b"", b"", *stat.read().rpartition(b")")[2].split()]
            start, room = int(fields[START]), int(fields[END]) - int(fields[START])
            # the system does not report it, or another program does this differently
            if start == 0 or len(shown.read()) != room:
                return
    except (OSError, ValueError, IndexError):
        return
    import ctypes  # which the server needs, but not the program that it is forked from

    text = b"\0".join(each.encode(errors="surrogateescape") for each in words)
    ctypes.memmove(start, text[: room - 1].ljust(room, b"\0"), room)
