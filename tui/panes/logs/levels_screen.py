"""The screen that shows and sets the levels of all nodes' loggers: lines that are not logged need not be hidden."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Future
from functools import partial
from typing import ClassVar

from bot_console.tui import keymap
from bot_console.tui.console.answer import Answer
from bot_console.tui.console.model import GraphInfo, LoggerLevel, Severity
from bot_console.tui.console.protocol import Console
from bot_console.tui.format import SEVERITY_CHARACTERS
from bot_console.tui.panes.pane import answer_of
from bot_console.tui.terminal.dimmed_screen import DimmedScreen
from bot_console.tui.text.sanitize import cut, sanitize
from bot_console.tui.widgets.box import Box
from bot_console.tui.widgets.item_list import ItemList
from bot_console.tui.widgets.static_text import StaticText
from rich.segment import Segment
from rich.text import Text
from textual.app import App, ComposeResult
from textual.binding import BindingType

HINT = "d i w e f Set level · u Inherit · Esc Close"
LEVELS = (Severity.DEBUG, Severity.INFO, Severity.WARN, Severity.ERROR, Severity.FATAL)


class LevelRows(ItemList[LoggerLevel]):
    """One logger per line, with its level among the others."""

    def key(self, item: LoggerLevel) -> object:
        """The logger's name, whatever its level."""
        return item.node, item.logger

    def row(self, index: int, width: int) -> list[Segment]:
        """The logger and the levels, with the current one in brackets."""
        level = self.rows[index]
        marks = "".join(
            f"[{SEVERITY_CHARACTERS[each]}]" if each is level.severity else f" {SEVERITY_CHARACTERS[each]} "
            for each in LEVELS
        )
        wide = min(40, max(len(each.logger) for each in self.rows))
        set_here = f"{level.severity.name} and worse" if level.severity else "as its parent"
        return [Segment(f" {cut(sanitize(level.logger), wide, pad=True)}  {marks}  {set_here}")]


class LevelsScreen(DimmedScreen):
    """Asks every node with logger services for its levels, and shows the answers as they arrive."""

    BINDINGS: ClassVar[list[BindingType]] = [*keymap.bindings("levels")]
    DEFAULT_CSS = """
    LevelsScreen { align: center middle; }
    LevelsScreen Box { width: 90%; max-width: 100; height: 60%; }
    """

    def __init__(self, console: Console, graph: GraphInfo) -> None:
        super().__init__()
        self._robot_console = console
        served = {each.name for each in graph.services}
        names = [each.name for each in graph.nodes if not each.hidden]
        self._offering = [each for each in names if f"{each}/set_logger_levels" in served]
        self._without = len(names) - len(self._offering)
        self._found: dict[str, Sequence[LoggerLevel]] = {}

    @property
    def _host(self) -> App[object]:
        return self.app  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType] -- Textual's App is generic

    def compose(self) -> ComposeResult:
        """The loggers, and the number of nodes without logger services."""
        with Box() as box:
            box.border_title = Text("Levels of loggers")
            box.border_subtitle = HINT
            yield LevelRows()
            yield StaticText(id="levels-state")

    @property
    def _list(self) -> LevelRows:
        return self.query_one(LevelRows)

    def on_mount(self) -> None:
        """Ask all nodes."""
        self._list.focus()
        self._show_text("")
        for each in self._offering:
            self._ask(each)

    def _show_text(self, what: str) -> None:
        every = self._without + len(self._offering)
        without = f"{self._without} of {every} nodes offer no logger service (enable_logger_service=True)"
        hint = without if self._without else ""
        self.query_one("#levels-state", StaticText).show_text(what or hint)

    def _ask(self, node: str) -> None:
        answer = self._robot_console.logs.levels(node)
        answer.add_done_callback(lambda done: self._host.call_later(self._levels_arrived, node, done))

    def _levels_arrived(self, node: str, done: Future[tuple[LoggerLevel, ...]]) -> None:
        if not self.is_running:  # the screen was closed in the meantime
            return
        error = done.exception()
        if error is not None:
            self._show_text(str(error))
            return
        self._found[node] = done.result()
        self._list.exchange([one for each in self._offering for one in self._found.get(each, ())])

    def action_level(self, severity: int) -> None:
        """Set the level of the logger at the cursor."""
        level = self._list.current
        if level is not None:
            answer = self._robot_console.logs.set_level(level.node, Severity(severity), level.logger)
            answer.add_done_callback(lambda done: self._host.call_later(partial(self._was_set, level.node), done))

    def _was_set(self, node: str, done: Future[Answer]) -> None:
        if self.is_running:
            answer = answer_of(done)
            self._show_text(answer.text if answer.ok else f"not set: {answer.text}")
            self._ask(node)
