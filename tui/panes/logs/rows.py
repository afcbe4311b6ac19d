"""The rows of the log pane."""

from __future__ import annotations

from dataclasses import replace
from typing import ClassVar

from bot_console.tui.console.logs.port import LogNumbers, LogSource
from bot_console.tui.console.model import LogRecord, Severity
from bot_console.tui.format import SEVERITY_CHARACTERS, clock_text
from bot_console.tui.panes.logs.names import NodeNames
from bot_console.tui.panes.logs.rules import COLOURS, RuleBook
from bot_console.tui.text.sanitize import cut, sanitize
from bot_console.tui.widgets.row_list import RowList
from rich.segment import Segment

STYLES = {Severity.DEBUG: "dim", Severity.WARN: "warn", Severity.ERROR: "error", Severity.FATAL: "error"}
NODE_CELLS, WIDE_NODE_CELLS, PLACE_CELLS = 18, 22, 26
"""Cells of a node's name, of a name if there is more room, and of the source location."""

MIN_CELLS_WITH_PLACE, MAX_EXTRA_NODE_CELLS = 150, 20
"""Minimum width (cells) of lines that show the source location, and how many of the cells beyond it node names may
use.
"""
MARK = "▌"
"""Precedes the text of a highlighted line, as not every terminal has colours."""


class LogRows(RowList):
    """The lines that pass the filter; stores only their numbers."""

    COMPONENT_CLASSES: ClassVar[set[str]] = {f"log-rows--{each}" for each in COLOURS}

    def __init__(self, source: LogSource, rules: RuleBook, names: NodeNames) -> None:
        super().__init__()
        self.source = source
        self.rules = rules
        self.numbers: LogNumbers | None = None
        self.names = names

    def row_count(self) -> int:
        """The number of lines."""
        return 0 if self.numbers is None else len(self.numbers)

    def number(self, index: int) -> int:
        """The number of the record on a line; -1 if there is none."""
        return self.numbers[index] if self.numbers is not None and 0 <= index < len(self.numbers) else -1

    def place(self, number: int) -> int:
        """The line of the record with that number, or of the next record shown."""
        return 0 if self.numbers is None else min(self.numbers.place(number), max(0, len(self.numbers) - 1))

    def place_at(self, stamp: int) -> int:
        """The newest line at a moment (ns since the epoch)."""
        low, high = 0, self.row_count()
        while low < high:
            middle = (low + high) // 2
            record = self.source.record(self.number(middle))
            if record is None or record.stamp <= stamp:
                low = middle + 1
            else:
                high = middle
        return max(0, low - 1)

    @property
    def record(self) -> LogRecord | None:
        """The record at the cursor."""
        return self.source.record(self.number(self.cursor))

    @property
    def named_record(self) -> LogRecord | None:
        """The record at the cursor, with its node's name as in the graph."""
        record = self.record
        return replace(record, node=self.names.of(record.node)) if record else None

    def saved_lines(self) -> list[str]:
        """All lines as ROS 2 writes them to a file."""
        records = (self.source.record(self.number(index)) for index in range(self.row_count()))
        return [
            f"[{each.severity.name}] [{each.stamp // 10**9}.{each.stamp % 10**9:09d}] "
            f"[{self.names.of(each.node)}]: {each.text}"
            for each in records
            if each is not None
        ]

    def first_of_row(self) -> int:
        """The number of the first record in the row at the cursor, which may represent several equal records."""
        return self.number(self.cursor - 1) + 1 if self.cursor else 0

    def show_nothing(self) -> None:
        """Remove all lines, before another log is shown."""
        self.numbers = None
        self.set_reactive(RowList.cursor, 0)
        self.rows_changed()

    def exchange(self, numbers: LogNumbers) -> None:
        """Replace the lines; the visible ones stay in place if they are among the new ones."""
        top = self.scroll_offset.y
        at, first = self.number(self.cursor), self.number(top)
        self.numbers = numbers
        if at >= 0:
            self.set_reactive(RowList.cursor, self.place(at))
        self.rows_changed()
        if first >= 0 and self.place(first) != top:
            self.scroll_to(y=self.place(first), animate=False, force=True)

    def row(self, index: int, width: int) -> list[Segment]:
        """One line: time, severity, node, text; one style for all of it."""
        record = self.source.record(self.number(index))
        if record is None or self.numbers is None:
            return [Segment("")]
        colour = self.rules.colour_of(record)
        name = f"log-rows--{colour}" if colour else f"row-list--{STYLES.get(record.severity, '')}"
        style = self.part_style(name) if colour or record.severity in STYLES else None
        text = line_text(
            record,
            self.names.of(record.node),
            width,
            self.names.longest,
            self.numbers.count(index),
            marked=bool(colour),
        )
        return [Segment(text, style)]


def line_text(
    record: LogRecord, node: str, width: int, longest: int = 0, count: int = 1, *, marked: bool = False
) -> str:
    """A record on one line; a narrow line omits the time, a wide one adds the source location.

    Long node names keep their ends; in a wide line, names get as many cells as the `longest` one needs. `count` is the
    number of equal records that the line represents, `marked` whether a rule highlights it.
    """
    time = f"{clock_text(record.stamp)} " if width >= 70 else ""
    room = (
        NODE_CELLS
        if width < 110
        else WIDE_NODE_CELLS
        + max(0, min(MAX_EXTRA_NODE_CELLS, (width - MIN_CELLS_WITH_PLACE) // 2, longest - WIDE_NODE_CELLS))
    )
    node = sanitize(node)
    node = "…" + node[1 - room :] if len(node) > room else node
    place = f" {cut(_place(record), PLACE_CELLS, pad=True)}" if width >= MIN_CELLS_WITH_PLACE else ""
    times = f"x{count} " if count > 1 else ""
    text = sanitize(record.text[: 4 * width])
    level = SEVERITY_CHARACTERS[record.severity]
    return f"{time}{level} {cut(node, room, pad=True)}{place}{MARK if marked else ' '}{times}{text}"


def _place(record: LogRecord) -> str:
    return f"{sanitize(record.file.replace(chr(92), '/').rpartition('/')[2])}:{record.line}" if record.file else ""
