"""The command line that `ps` and `pkill -f` show for this process. Linux only; elsewhere it stays the parent's."""

from __future__ import annotations

from collections.abc import Sequence

START, END = 47, 48
"""Fields of `/proc/self/stat` (proc(5), counted from 0): start and end of the memory with the command line."""


def show_command(words: Sequence[str]) -> None:
    """Show other words from now on, cut to the length of the interpreter's own command line.

    A fork otherwise shows its parent's: a signal that a shell sends to every `ros2 launch` would also reach the nodes,
    in addition to the signal that the launch then sends them.
    """
    try:
        with open("/proc/self/stat", "rb") as stat, open("/proc/self/cmdline", "rb") as shown:
            # The second field may contain blanks and parentheses.
            fields = [b"", b"", *stat.read().rpartition(b")")[2].split()]
            start, room = int(fields[START]), int(fields[END]) - int(fields[START])
            # the system does not report it, or another program has changed the memory
            if start == 0 or len(shown.read()) != room:
                return
    except (OSError, ValueError, IndexError):
        return
    import ctypes  # needed by the server, but not by the program that it is forked from

    text = b"\0".join(each.encode(errors="surrogateescape") for each in words)
    ctypes.memmove(start, text[: room - 1].ljust(room, b"\0"), room)
