"""The diagnostics pane: the status of every part of the robot, as a tree whose parents show the worst level below."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from typing import Any

from bot_console.tui import keymap
from bot_console.tui.console.model import ConsoleSnapshot
from bot_console.tui.console.sensors.diagnostic_status import Diagnostics, Level, Status
from bot_console.tui.format import clock_text
from bot_console.tui.panes.diagnostics.table import LEVEL_STYLES, StatusRows
from bot_console.tui.panes.diagnostics.tree import Row, matches, rows
from bot_console.tui.panes.list_pane import ListPane
from bot_console.tui.screens.facts import FactsScreen, Section
from bot_console.tui.text.counted import counted
from bot_console.tui.text.redraw_interval import is_due
from bot_console.tui.text.sanitize import sanitize
from bot_console.tui.widgets.placeholder import FILTERED_OUT, Placeholder
from bot_console.tui.widgets.prompt.line import Prompt
from bot_console.tui.widgets.row_list import RowList
from bot_console.tui.widgets.static_text import StaticText
from rich.cells import cell_len
from rich.text import Text
from textual.app import ComposeResult
from textual.containers import Container

POLL_S = 0.5
"""Seconds between two refreshes."""
MAX_KEY_CELLS = 30
"""Maximum width (cells) of the column of keys; a longer key moves only its own value."""
MIN_SIDE_BY_SIDE_CELLS = 110
"""Minimum width (cells) at which the list and the details are shown side by side."""
EMPTY = Placeholder(
    "Nodes report their own health here; no node publishes diagnostics yet (diagnostic_msgs/msg/DiagnosticArray).",
    (("3", "See the nodes and topics"), ("8", "Start nodes"), ("?", "Help")),
)
ALL_OK = Placeholder("All is OK.", (("w", "Show everything"),))


class DiagnosticsPane(ListPane):
    """Diagnostics as a tree."""

    TITLE = "Diagnostics"
    HELP = (
        "The status that the parts of the robot report on /diagnostics (on /diagnostics_agg if there is an\n"
        "aggregator), as a tree by the slashes in their names. A parent row shows the worst level below it: error,\n"
        "then stale, then warning. A status that was not repeated for 5 s is stale. Below, or beside it where there\n"
        "is room: the values of the row at the cursor, and every level it has had since the console started."
    )
    BINDINGS = keymap.bindings("diagnostics")

    clock: Callable[[], float] = staticmethod(time.monotonic)
    """The monotonic clock (s) with which arriving statuses are stamped; tests replace it with one that they step."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._info = Diagnostics()
        self._problem = ""
        self._bad_only = False
        self._folded: frozenset[str] = frozenset()
        self._polled = 0.0
        self._due = 0.0
        """When the next status grows a second older, and perhaps stale, so that the list changes without new data."""

    def compose(self) -> ComposeResult:
        """The tree, details of the row at the cursor, and a prompt."""
        with Container(id="diagnostics-body"):
            yield StatusRows()
            yield StaticText(id="diagnostics-detail")
        yield Prompt(id="diagnostics-prompt")

    @property
    def _list(self) -> StatusRows:
        return self.query_one(StatusRows)

    def show(self, snapshot: ConsoleSnapshot) -> None:
        """Update at once if the reason why there may be no diagnostics has changed, otherwise once per `POLL_S`."""
        if snapshot.problem != self._problem:
            self._problem = snapshot.problem
            self._due = 0.0
            self._poll()
        elif self._is_poll_due():
            self._poll()

    def tick(self) -> None:
        """Update the tree while it is visible."""
        if self.display and self._is_poll_due():
            self._poll()

    def _is_poll_due(self) -> bool:
        return is_due(self._polled, self.clock(), POLL_S)

    def _poll(self) -> None:
        now = self._polled = self.clock()
        info = self.console.sensors.diagnostics()
        if info is not self._info or now >= self._due:
            self._info = info
            self._arrange()

    def _arrange(self) -> None:
        """Show the statuses that pass the filter."""
        every = self._info.statuses
        passing = [each for each in every if not self._query.terms or matches(each, self._query)]
        now = self.clock()
        self._due = min((each.last_received + int(now - each.last_received) + 1 for each in every), default=math.inf)
        self._list.exchange(rows(passing, now, self._folded, bad_only=self._bad_only))
        shown = sum(not self._bad_only or each.now(now) is not Level.OK for each in passing)
        more = f"{self._info.dropped} more names not kept" if self._info.dropped else ""
        self.report_filter(shown, len(every), "not OK" if self._bad_only else "", more)
        self._describe()

    def _describe(self) -> None:
        row, detail = self._list.current, self.query_one("#diagnostics-detail", StaticText)
        self._list.show_placeholder((ALL_OK if self._bad_only else FILTERED_OUT) if self._info.statuses else EMPTY)
        detail.set_class(row is None, "sentence")
        detail.show_or_hide(self._details(row))

    def _details(self, row: Row | None) -> Text:
        if row is None:
            return Text(sanitize(self._problem or self._info.problem), "dim")
        if row.status is None:
            return Text(below_text(row))
        text = Text(no_wrap=True, overflow="ellipsis")
        for heading, lines in sections(row.status, self.clock()):
            if lines:
                text.append(f"{sanitize(heading)}\n", "bold")
                text.append("".join(f"  {sanitize(line)}\n" for line in lines))
        return text

    def on_row_list_moved(self, event: RowList.Moved) -> None:
        """Describe the row at the cursor."""
        event.stop()
        self._describe()

    def on_status_rows_pressed(self, event: StatusRows.Pressed) -> None:
        """Fold, unfold or open the clicked row."""
        event.stop()
        row = self._list.current
        if event.on_mark and row is not None:
            self.action_fold(not row.folded)
        else:
            self.action_open()

    def action_clear_filter(self) -> None:
        """Show everything again."""
        self._bad_only = False
        self.set_filter("")

    def action_bad_only(self) -> None:
        """Switch between showing only what is not OK and everything."""
        self._bad_only = not self._bad_only
        self._arrange()

    def action_open(self) -> None:
        """Show all details of a status; fold or unfold a part that only contains others."""
        row = self._list.current
        if row is not None and row.status is not None:
            self.host.push_screen(FactsScreen(sanitize(row.status.name), sections(row.status, self.clock())))
        elif row is not None:
            self.action_fold(not row.folded)

    def action_fold(self, closed: bool) -> None:
        """Fold or unfold the row at the cursor, or fold its parent."""
        shown, row = self._list, self._list.current
        if row is None:
            return
        if closed and (not row.count or row.folded):
            above = (at for at in range(shown.cursor, -1, -1) if shown.rows[at].depth < row.depth)
            at = next(above, shown.cursor)
            shown.cursor, row = at, shown.rows[at]
        self._folded = self._folded - {row.path} | ({row.path} if closed and row.count else frozenset[str]())
        self._arrange()

    def action_fold_all(self) -> None:
        """Fold all parts that contain others, or unfold everything."""
        paths = frozenset(each.path for each in self._list.rows if each.count)
        self._folded = frozenset() if self._folded else paths
        self._arrange()

    def on_resize(self) -> None:
        """Place list and detail side by side if there is room."""
        self.set_class(self.size.width >= MIN_SIDE_BY_SIDE_CELLS, "side")


def sections(status: Status, now: float) -> list[Section]:
    """The message of a status, its values, and its history, newest first."""
    level, age = status.now(now), int(now - status.last_received)
    head = [f"{LEVEL_STYLES[level][0]} {level.name}  {status.message}"]
    if level is Level.STALE and status.level is not level:
        head.append(f"silent for {counted(age, 'second')}; it was {status.level.name}")
    if status.hardware:
        head.append(f"hardware {status.hardware}")
    wide = min(max((cell_len(key) for key, _ in status.values), default=0), MAX_KEY_CELLS)
    values = [f"{key}{' ' * (wide - cell_len(key))}  {value}" for key, value in status.values]
    reported = [
        f"{clock_text(each.stamp)[:8]}  {each.level.name:<5}  {each.message}" for each in reversed(status.history)
    ]
    return [(status.name, head), ("values", values), ("was", reported)]


def below_text(row: Row) -> str:
    """The details of a part that only contains others."""
    return f"{sanitize(row.path)}\n  {row.count - row.bad} of {row.count} OK"
