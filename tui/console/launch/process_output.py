"""Converts the output of processes to log records. A mark, not the wording, distinguishes a logger's lines from printed
text.

`/rosout` takes precedence: it brings the lines of every node, whoever has started it. A marked line says whether it was
published there too, so that no line is added twice. Only printed text and the lines that were not published are added
here: those of a node without `/rosout`, of a logger without a node, or after `rclpy.shutdown()`.

The mark is a log format, set through the public `RCUTILS_CONSOLE_OUTPUT_FORMAT`; the user's own format stays inside it.
The embedded rclpy also takes it from `BOT_CONSOLE_LOG_ENVELOPE`, which no launch file overrides, and adds whether the
line was published on `/rosout`. A real rclpy does not know that field: see `UndecidedLines`.
"""

from __future__ import annotations

import re
import time
from collections import deque
from collections.abc import Callable, Mapping

from bot_console.tui.console.logs.tracebacks import PrintedLines

FORMAT_VARIABLE = "RCUTILS_CONSOLE_OUTPUT_FORMAT"
ENVELOPE_VARIABLE = "BOT_CONSOLE_LOG_ENVELOPE"
BEGIN, PART, END = "\x1e", "\x1d", "\x1f"
FIELDS = ("{severity}", "{time_as_nanoseconds}", "{name}", "{file_name}", "{function_name}", "{line_number}",
          "{on_rosout}", "{message}", "{line}")  # fmt: skip
ENVELOPE = BEGIN + PART.join(FIELDS) + END
LEVELS = {"DEBUG": 10, "INFO": 20, "WARN": 30, "ERROR": 40, "FATAL": 50}
COLOUR = r"(?:\x1b\[[0-9;]*m)?"
_BEGIN = re.compile(COLOUR + BEGIN)
_END = re.compile(f"{END}{COLOUR}\r?\n")
MAX_RECORD_CHARACTERS = 1 << 20
"""Characters kept while waiting for the end of a line or record, since a program may never end one."""
MAX_TIME_NS = 2**63 - 1
"""The latest time, in ns since the epoch, that fits a column of the log."""
ROSOUT_TIMEOUT_S = 2.0
"""Seconds that a line waits for `/rosout` to bring the first line of its logger."""

Add = Callable[[int, int, str, str, tuple[str, str, int]], None]
"""Receives stamp (ns), severity, logger name, text, and (file, function, line)."""
Record = tuple[int, int, str, str, tuple[str, str, int]]


def marking_variables(environment: Mapping[str, str]) -> dict[str, str]:
    """The variables that make loggers mark their lines; a format in the given environment is kept inside the mark."""
    return {
        ENVELOPE_VARIABLE: ENVELOPE,
        FORMAT_VARIABLE: ENVELOPE.replace("{line}", environment.get(FORMAT_VARIABLE, "")),
    }


class ProcessOutput:
    """Converts the output of one process, on both streams."""

    def __init__(
        self,
        label: str,
        record: Add,
        printed: Callable[[int, str, str], None],
        heard: Callable[[str], bool] = lambda name: True,
        every: Add | None = None,
    ) -> None:
        """`heard` says whether a line of a logger has arrived over `/rosout`; `every` receives all lines of loggers."""
        self._record = record
        self._every = every
        self._undecided = UndecidedLines(record, heard)
        self._streams = {stderr: PrintedLines(label, printed, stderr=stderr) for stderr in (False, True)}
        self._readers = {stderr: OutputReader(self.logged, each.line) for stderr, each in self._streams.items()}

    def feed(self, text: str, *, stderr: bool) -> None:
        """Process the next piece of output."""
        self._readers[stderr].feed(text)

    def logged(self, record: Record, on_rosout: bool | None) -> None:
        """Process a logger's line; `on_rosout` is None if the line does not say whether it was published on
        `/rosout`.
        """
        if self._every is not None:
            self._every(*record)
        if on_rosout is None:
            self._undecided.wait(record)
        elif not on_rosout:
            self._record(*record)

    @property
    def fault(self) -> str:
        """The last exception printed, with its place in the user's code, on one line; empty if there was none."""
        return self._streams[True].fault or self._streams[False].fault

    def settle(self) -> None:
        """Decide on lines that have waited long enough; to be called regularly."""
        self._undecided.settle()

    def close(self) -> None:
        """Process the rest of the output after the process has ended."""
        for stderr, reader in self._readers.items():
            reader.close()
            self._streams[stderr].close()
        self._undecided.settle(ended=True)


class UndecidedLines:
    """Lines of a real rclpy or rclcpp, which do not say whether they were published on `/rosout`.

    A line counts as published if `/rosout` has brought any line of its logger. A logger's first line can arrive here
    before it arrives over `/rosout`, so each line waits for `ROSOUT_TIMEOUT_S` before it is added.
    """

    def __init__(self, record: Add, heard: Callable[[str], bool], now: Callable[[], float] = time.monotonic) -> None:
        self._record = record
        self._heard = heard
        self._now = now
        self._waiting: deque[tuple[float, Record]] = deque()

    def wait(self, record: Record) -> None:
        """Keep a line for now, unless lines of its logger have arrived over `/rosout`."""
        if not self._heard(record[2]):
            self._waiting.append((self._now() + ROSOUT_TIMEOUT_S, record))
        self.settle()

    def settle(self, *, ended: bool = False) -> None:
        """Decide on lines that have waited long enough, or on all lines if the process has ended."""
        now = self._now()
        while self._waiting and (ended or self._waiting[0][0] <= now):
            _, record = self._waiting.popleft()
            if not self._heard(record[2]):
                self._record(*record)


class OutputReader:
    """Splits the output of one stream, which arrives in pieces of any size, into records and printed lines."""

    def __init__(self, logged: Callable[[Record, bool | None], None], printed: Callable[[str], None]) -> None:
        self._logged = logged
        self._printed = printed
        self._rest = ""

    def feed(self, text: str) -> None:
        """Process the next piece of output; an unfinished line or record waits for its end, unless it is very long."""
        self._process_text(self._rest + text)
        if len(self._rest) > MAX_RECORD_CHARACTERS:
            rest, self._rest = self._rest, ""
            self._printed(rest)

    def _process_text(self, text: str) -> None:
        at = 0
        while begin := _BEGIN.search(text, at):
            if begin.start() > at:
                self._lines(text[at : begin.start()] + "\n")
            end = _END.search(text, begin.end())
            if end is None:
                self._rest = text[begin.start() :]
                return
            self._process_record(text[begin.end() : end.start()])
            at = end.end()
        self._rest = self._lines(text[at:])

    def close(self) -> None:
        """Process the rest, a line without a newline, after the process has ended."""
        rest, self._rest = self._rest, ""
        begin = _BEGIN.match(rest)
        if begin and END in rest:
            self._process_record(rest[begin.end() : rest.rindex(END)])
        elif rest.strip():
            self._printed(rest[begin.end() if begin else 0 :])

    def _lines(self, text: str) -> str:
        *whole, rest = text.split("\n")
        for line in whole:
            if line.strip():
                self._printed(line.rstrip("\r"))
        return rest

    def _process_record(self, text: str) -> None:
        parts = text.split(PART, len(FIELDS) - 2)
        if len(parts) != len(FIELDS) - 1 or not _is_number(parts[1]):
            self._printed(text)
            return
        severity, stamp, name, file, function, line, on_rosout, rest = parts
        message = rest.rpartition(PART)[0]
        number = int(line) if _is_number(line) else 0
        record = (int(stamp), LEVELS.get(severity, 20), name, message, (file, function, number))
        self._logged(record, {"0": False, "1": True}.get(on_rosout))


def _is_number(text: str) -> bool:
    """Whether a text is an integer that fits a column of the log; a node may print anything in place of a mark."""
    return text.isascii() and text.isdecimal() and len(text) <= len(str(MAX_TIME_NS)) and int(text) <= MAX_TIME_NS
