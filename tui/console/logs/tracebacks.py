"""Turns printed lines into log records: a traceback becomes one ERROR that starts with the exception, followed by the
user's frames.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby

from bot_console.tui.console.user_code import is_library_file

TRACEBACK = "Traceback (most recent call last):"
LINKS = {
    "The above exception was the direct cause of the following exception:": "caused by",
    "During handling of the above exception, another exception occurred:": "while handling",
}
INFO, WARN, ERROR = 20, 30, 40
_FRAME = re.compile(r'  File "(?P<file>.+)", line (?P<line>\d{1,9})(?:, in (?P<function>.+))?$')
_CARETS = re.compile(r"\s+[\^~\s]+$")


@dataclass(frozen=True)
class TracebackFrame:
    """One call in a traceback, with its source line if that was printed."""

    file: str
    line: int
    function: str
    source: str = ""

    @property
    def place(self) -> str:
        """The file name (without folders) and the line number."""
        return f"{_name(self.file)}:{self.line}"


class Traceback:
    """A traceback as Python prints it, line by line; the last line is the exception."""

    def __init__(self, lines: Sequence[str], link: str = "") -> None:
        self.exception = lines[-1]
        self._link = link
        self._lines = lines
        self.frames = tuple(_frames(lines[1:-1]))

    @property
    def own(self) -> TracebackFrame | None:
        """The innermost frame that is neither in the runtime nor in a library."""
        return next((each for each in reversed(self.frames) if not is_library_file(each.file)), None)

    @property
    def reason(self) -> str:
        """The exception and its place in the user's code, on one line."""
        return f"{self.exception} ({self.own.place})" if self.own else self.exception

    def text(self) -> str:
        """The exception, then the frames, innermost first; library frames are folded unless there are no others."""
        lines = [self.exception, *([f"  {self._link}"] if self._link else [])]
        for library, group in groupby(reversed(self.frames), lambda each: is_library_file(each.file)):
            frames = list(group)
            if library and self.own:
                lines.append(f"  ({len(frames)} {'call' if len(frames) == 1 else 'calls'} in libraries)")
                continue
            for each in frames:
                lines.append(f'  File "{each.file}", line {each.line}, in {each.function}')
                lines += [f"    {each.source}"] if each.source else []
        return "\n".join(lines if self.frames else [self.exception, *self._lines[1:-1]])


def _name(file: str) -> str:
    return re.split(r"[/\\]", file)[-1]


def _frames(lines: Sequence[str]) -> Iterator[TracebackFrame]:
    for index, text in enumerate(lines):
        found = _FRAME.match(text)
        if found:
            after = lines[index + 1] if index + 1 < len(lines) else ""
            source = after.strip() if after.startswith("    ") and not _CARETS.match(after) else ""
            yield TracebackFrame(found["file"], int(found["line"]), found["function"] or "<module>", source)


class PrintedLines:
    """Turns lines of one stream into log records: a traceback into one ERROR, any other line into one INFO or WARN."""

    def __init__(self, label: str, add: Callable[[int, str, str], None], *, stderr: bool) -> None:
        self._label = label
        self._add = add
        self._severity = WARN if stderr else INFO
        self._open: list[str] = []
        self._link = ""
        self.last: Traceback | None = None
        """The newest traceback."""
        self.fault = ""
        """The exception and where it was raised; empty once something was printed after the traceback."""

    def line(self, text: str) -> None:
        """Process one line."""
        self.fault = ""
        if self._open:
            self._open.append(text)
            if not text.startswith((" ", "\t")):
                self._end()
        elif text.startswith(TRACEBACK):
            self._open = [text]
        elif text in LINKS and self.last is not None:
            self._link = f"{LINKS[text]} {self.last.exception}"
        else:
            self._add(self._severity, self._label, text)

    def _end(self) -> None:
        self.last = Traceback(self._open, self._link)
        self._open, self._link = [], ""
        self.fault = self.last.reason
        self._add(ERROR, self._label, self.last.text())

    def close(self) -> None:
        """Add a traceback that the end of the process has cut off."""
        if self._open:
            self._add(ERROR, self._label, "\n".join(["a traceback that was cut off", *self._open[1:]]))
            self._open = []
