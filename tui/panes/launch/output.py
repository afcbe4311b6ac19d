"""The newest log and output lines of the process at the cursor, or of the processes of the group there."""

from __future__ import annotations

from collections.abc import Iterable

from bot_console.tui.console.model import Severity
from bot_console.tui.format import SEVERITY_CHARACTERS, clock_text
from bot_console.tui.panes.launch.follow import OutputLine
from bot_console.tui.text.sanitize import cut, sanitize
from bot_console.tui.widgets.picture import Line, Picture

STYLES = {Severity.WARN: "warn", Severity.ERROR: "error", Severity.FATAL: "error"}


class ProcessOutput(Picture):
    """The newest lines, below the name of the process or group."""

    def __init__(self, *, id: str | None = None) -> None:
        super().__init__(id=id)
        self._drawn: object = None
        """The input of the last drawing, which is repeated only if this changes."""
        self._place: object = None
        self._first = 0
        """The number of the log record in the first line."""

    def show_lines(self, name: str, lines: Iterable[OutputLine], *, named: bool) -> None:
        """Show the newest lines; with `named`, each line names the node or process that it is from."""
        place = name, self.size.width, max(0, self.size.height - 1)
        newest = self._in_room(sorted(lines, key=lambda each: each.record.seq), place)
        drawn = place, newest[-1].record.seq if newest else -1
        if drawn == self._drawn:
            return
        self._drawn = drawn
        width = self.size.width
        what = f"output of {name}" if newest else f"{name} has logged and printed nothing yet"
        head = rule(what if name else "", width)
        shown: list[Line] = [
            ((_text(each, width, named=named), STYLES.get(each.record.severity, "")),) for each in newest
        ]
        blank: list[Line] = [()] * (place[2] - len(shown))
        self.set_lines([head, *shown, *blank])

    def _in_room(self, lines: list[OutputLine], place: tuple[str, int, int]) -> list[OutputLine]:
        """The lines that fit.

        When the room is used up, a third of it is freed at once: moving all lines up with each new one would redraw
        all of them every time.
        """
        room = place[2]
        is_another_log = bool(lines) and lines[-1].record.seq < self._first
        if place != self._place or is_another_log:
            self._place = place
            kept = lines[-room:] if room else []
        else:
            kept = [each for each in lines if each.record.seq >= self._first]
            if len(kept) > room:
                kept = kept[-max(1, room - room // 3) :] if room else []
        self._first = kept[0].record.seq if kept else 0
        return kept


def rule(title: str, width: int) -> Line:
    """A line across the pane with a title in its middle."""
    return ((cut((f" {title} " if title else "").center(width, "─"), width), "dim"),)


def _text(line: OutputLine, width: int, *, named: bool) -> str:
    """A line of the log with its number of repeats; with `named`, also with the node or process that it is from."""
    record = line.record
    mark = SEVERITY_CHARACTERS.get(record.severity, " ")
    who = f"{sanitize(record.node)}  " if named else ""
    text = f" {clock_text(record.stamp)[:8]} {mark} {who}{sanitize(record.text.splitlines()[0] if record.text else '')}"
    count = f"  ×{line.count} " if line.count > 1 else ""
    return cut(text, width - len(count), pad=bool(count)) + count
