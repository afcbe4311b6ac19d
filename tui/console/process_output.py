"""What processes print, as log records: the lines of ROS loggers are told from prints by a mark in their format.

A logger writes each line to the console and publishes it on `/rosout`; a print does only the first. The mark, set
through the public `RCUTILS_CONSOLE_OUTPUT_FORMAT`, keeps the two apart: nothing shows twice and nothing is lost.
"""

from __future__ import annotations

import threading
from collections import OrderedDict
from collections.abc import Callable

FORMAT_VARIABLE = "RCUTILS_CONSOLE_OUTPUT_FORMAT"
BEGIN, PART, END = "\x1e", "\x1d", "\x1f"
MARKED_FORMAT = (
    f"{BEGIN}{{severity}}{PART}{{time_as_nanoseconds}}{PART}{{name}}{PART}{{file_name}}{PART}{{function_name}}{PART}"
    f"{{line_number}}{PART}{{message}}{END}"
)
FIELDS = 7
LEVELS = {"DEBUG": 10, "INFO": 20, "WARN": 30, "ERROR": 40, "FATAL": 50}
REMEMBERED = 4096

TRACEBACK = "Traceback (most recent call last):"

Add = Callable[[int, int, str, str, tuple[str, str, int]], None]
"""Takes stamp (ns), severity, logger name, text, and (file, function, line)."""


class Once:
    """Passes each log record on once, although it comes by `/rosout` and by the console, in either order."""

    def __init__(self, add: Add) -> None:
        self._add = add
        self._lock = threading.Lock()
        self._seen: OrderedDict[tuple[int, str, str], None] = OrderedDict()

    def record(self, stamp: int, severity: int, name: str, text: str, site: tuple[str, str, int]) -> None:
        """Pass a record on unless it came before; from any thread."""
        key = (stamp, name, text)
        with self._lock:
            if self._seen.pop(key, self) is None:
                return
            self._seen[key] = None
            if len(self._seen) > REMEMBERED:
                self._seen.popitem(last=False)
        self._add(stamp, severity, name, text, site)


class ProcessOutput:
    """What one process prints, on either stream."""

    def __init__(self, label: str, record: Add, printed: Callable[[int, str, str], None]) -> None:
        self._streams = {stderr: Printed(label, printed, stderr=stderr) for stderr in (False, True)}
        self._readers = {stderr: OutputReader(record, each.line) for stderr, each in self._streams.items()}

    def feed(self, text: str, *, stderr: bool) -> None:
        """Take the next piece."""
        self._readers[stderr].feed(text)

    def close(self) -> None:
        """The process has ended."""
        for stderr, reader in self._readers.items():
            reader.close()
            self._streams[stderr].close()


class OutputReader:
    """Turns the output of one process, in whatever pieces it comes, into records and printed lines."""

    def __init__(self, record: Add, printed: Callable[[str], None]) -> None:
        self._record = record
        self._printed = printed
        self._rest = ""

    def feed(self, text: str) -> None:
        """Take the next piece of output; an unfinished line or record waits for its end."""
        text = self._rest + text
        while True:
            begin = text.find(BEGIN)
            if begin < 0:
                self._rest = self._lines(text)
                return
            if begin > 0:
                self._lines(text[:begin] + "\n")
            end = text.find(END, begin)
            if end < 0:
                self._rest = text[begin:]
                return
            self._marked(text[begin + 1 : end])
            text = text[end + 1 :].removeprefix("\n")

    def close(self) -> None:
        """The process has ended: what is left is a line without an end."""
        rest, self._rest = self._rest, ""
        if rest.strip():
            self._printed(rest.lstrip(BEGIN))

    def _lines(self, text: str) -> str:
        *whole, rest = text.split("\n")
        for line in whole:
            if line.strip():
                self._printed(line.rstrip("\r"))
        return rest

    def _marked(self, text: str) -> None:
        parts = text.split(PART, FIELDS - 1)
        if len(parts) != FIELDS or not parts[1].isdigit():
            self._printed(text)
            return
        severity, stamp, name, file, function, line, message = parts
        number = int(line) if line.isdigit() else 0
        self._record(int(stamp), LEVELS.get(severity, 20), name, message, (file, function, number))


class Printed:
    """Printed lines of one process as log records: a traceback is one ERROR, every other line one INFO or WARN."""

    def __init__(self, label: str, add: Callable[[int, str, str], None], *, stderr: bool) -> None:
        self._label = label
        self._add = add
        self._severity = LEVELS["WARN"] if stderr else LEVELS["INFO"]
        self._traceback: list[str] = []

    def line(self, text: str) -> None:
        """Take one line."""
        if self._traceback:
            self._traceback.append(text)
            if not text.startswith((" ", "\t")):
                self._add(LEVELS["ERROR"], self._label, "\n".join(self._traceback))
                self._traceback = []
        elif text.startswith(TRACEBACK):
            self._traceback = [text]
        else:
            self._add(self._severity, self._label, text)

    def close(self) -> None:
        """The process has ended: a traceback that was cut off is shown as far as it came."""
        if self._traceback:
            self._add(LEVELS["ERROR"], self._label, "\n".join(self._traceback))
            self._traceback = []
