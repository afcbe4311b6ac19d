"""The tf2 frames, shown instead of the drawing: a tree of rows, updated while it is visible."""

from __future__ import annotations

from collections.abc import Sequence

from bot_console.tui.console.filter_syntax import Query, parse
from bot_console.tui.console.sensors.frames import Frames, findings
from bot_console.tui.console.sensors.port import Sensors
from bot_console.tui.panes.graph.frame_rows import FrameRows
from bot_console.tui.panes.graph.frame_tree import facts, rows, summary
from bot_console.tui.screens.facts import FactsScreen
from bot_console.tui.text.counted import counted
from bot_console.tui.text.sanitize import sanitize
from bot_console.tui.widgets.prompt.question import Option
from textual.app import App, ComposeResult
from textual.containers import Container

FRAMES_POLL_S = 0.5
"""Seconds between two refreshes."""


class FramesView(Container):
    """The list of frames with its details."""

    DEFAULT_CSS = "FramesView { height: 1fr; display: none; }"

    def __init__(self) -> None:
        super().__init__()
        self.open = False
        self._watched_by: Sensors | None = None
        self._polled = 0.0
        self._info = Frames()
        self._query = Query()
        self._words = ""
        self._count = 0

    def compose(self) -> ComposeResult:
        """The list."""
        yield FrameRows()

    @property
    def _rows(self) -> FrameRows:
        return self.query_one(FrameRows)

    def toggle(self) -> None:
        """Open or close the list."""
        self.open = not self.open
        self.display = self.open
        self._polled = 0.0

    def take_focus(self) -> None:
        """Focus the list."""
        self._rows.focus()

    def poll(self, sensors: Sensors, clock: float, *, seen: bool) -> None:
        """Watch the frames while the list is open and visible, and update it when due."""
        wanted = self.open and seen
        if self._watched_by is not (sensors if wanted else None):  # a different one after a reconnection
            self._watched_by = sensors if wanted else None
            sensors.watch_frames(wanted)
        if wanted and clock - self._polled >= FRAMES_POLL_S:
            self._polled = clock
            self._info = sensors.frames()
            self._count = sum(1 for _ in findings(self._info, clock))
            self._arrange(clock)

    def _arrange(self, clock: float) -> None:
        self._rows.exchange(rows(self._info, clock, self._query))

    def filter_by(self, words: str) -> None:
        """Show the frames that pass the filter, and their ancestors."""
        self._query, self._words = parse(words), words
        if self.open:
            self._arrange(self._polled)

    def find(self, query: Query, step: int) -> bool:
        """Go to the next matching frame; returns whether there is one."""
        return self._rows.find(query, step)

    def is_on_match(self, query: Query) -> bool:
        """Whether the frame at the cursor matches."""
        row = self._rows.current
        return row is not None and query.matches(row.name)

    @property
    def caption(self) -> str:
        """The filter, and the numbers of transforms and findings."""
        info = self._info
        parts = ["frames of tf2", f"/{self._words}" if self._words else ""]
        parts += [counted(len(info.frames), "transform") if info.frames else ""]
        parts += [f"w {counted(self._count, 'finding')}" if self._count else ""]
        parts += [f"{info.dropped} more not kept" if info.dropped else ""]
        return " · ".join(filter(None, parts))

    @property
    def summary(self) -> str:
        """A one-line description of the frame at the cursor."""
        return sanitize(summary(self._rows.current, self._info))

    def anomalies(self, clock: float) -> Sequence[Option]:
        """The findings, each with its frame."""
        return [Option(text, "", name) for name, text in findings(self._info, clock)]

    def go_to(self, name: str) -> None:
        """Put the cursor on a frame."""
        shown = self._rows
        shown.cursor = next((at for at, each in enumerate(shown.rows) if each.name == name), shown.cursor)

    def show_facts(self, host: App[object], clock: float) -> None:
        """Show all details of the frame at the cursor."""
        row = self._rows.current
        if row is not None:
            host.push_screen(FactsScreen(sanitize(row.name), facts(row, self._info, clock)))
