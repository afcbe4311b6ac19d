"""The log pane: every node's lines, filtered by severity and words, as many as there may be."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from bot_console.tui import keymap
from bot_console.tui.console.model import ConsoleSnapshot, LogFilter, LogRecord, LogState, Severity
from bot_console.tui.console.protocol import Console, LogFindings, LogNumbers, LogView
from bot_console.tui.format import LETTERS, clock_text, cut, harmless
from bot_console.tui.panes.pane import Pane
from bot_console.tui.save_file import save_file
from bot_console.tui.screens.detail import DetailScreen
from bot_console.tui.widgets.prompt.common import filter_line
from bot_console.tui.widgets.prompt.line import Prompt
from bot_console.tui.widgets.row_list import RowList
from bot_console.tui.widgets.words import Words
from rich.segment import Segment
from textual.app import ComposeResult

LEVELS = (Severity.UNSET, Severity.INFO, Severity.WARN, Severity.ERROR)
STYLES = {Severity.DEBUG: "dim", Severity.WARN: "warn", Severity.ERROR: "error", Severity.FATAL: "error"}
NODE = 18


class LogRows(RowList):
    """The lines that pass the filter; holds their numbers only."""

    def __init__(self, console: Console) -> None:
        super().__init__()
        self.console = console
        self.numbers: LogNumbers | None = None

    def row_count(self) -> int:
        """How many lines there are."""
        return 0 if self.numbers is None else len(self.numbers)

    def number(self, index: int) -> int:
        """The number of the record on a line; -1 where there is none."""
        return self.numbers[index] if self.numbers is not None and 0 <= index < len(self.numbers) else -1

    def place(self, number: int) -> int:
        """The line of the record with that number, or of the next one that is shown."""
        return 0 if self.numbers is None else min(self.numbers.place(number), max(0, len(self.numbers) - 1))

    def exchange(self, numbers: LogNumbers) -> None:
        """Show other lines; what is seen stays where it is, as far as it is among them."""
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
        record = self.console.log(self.number(index))
        if record is None:
            return [Segment("")]
        name = STYLES.get(record.severity)
        style = self.get_component_rich_style(f"row-list--{name}", partial=True) if name else None
        return [Segment(line_text(record, width), style)]


def line_text(record: LogRecord, width: int) -> str:
    """A record on one line; the time is left out where there is little room."""
    time = f"{clock_text(record.stamp)} " if width >= 70 else ""
    node = record.node.rpartition("/")[2] if len(record.node) > NODE else record.node
    text = harmless(record.text[: 4 * width])
    return f"{time}{LETTERS[record.severity]} {cut(harmless(node), NODE, pad=True)} {text}"


def rotated(numbers: Sequence[int], now: int) -> Sequence[int]:
    """Rising numbers, those above one of them first."""
    at = bisect_right(numbers, now)
    return [*numbers[at:], *numbers[:at]]


class LogsPane(Pane):
    """Log lines of all nodes."""

    TITLE = "Logs"
    HELP = (
        "What the nodes log and print. The filter takes words (all must stand), !word (must not), node:name,\n"
        "sev:>=warn and re:pattern. Scrolling up stops following; nothing is lost meanwhile, f follows again."
    )
    BINDINGS = keymap.bindings("logs")

    def __init__(self, *args: object, **kwargs: object) -> None:
        super().__init__(*args, **kwargs)  # type: ignore[arg-type]
        self._state = LogState()
        self._which = LogFilter()
        self._view: LogView | None = None
        self._found: LogFindings | None = None
        self._following = True

    def compose(self) -> ComposeResult:
        """The lines, what is filtered, a prompt."""
        yield LogRows(self.console)
        yield Words(id="log-status")
        yield Prompt(id="log-prompt")

    @property
    def _list(self) -> LogRows:
        return self.query_one(LogRows)

    def focus_target(self) -> None:
        """The lines take the keys."""
        self._list.focus()

    def show(self, snapshot: ConsoleSnapshot) -> None:
        """Take in what is new in the log."""
        state = snapshot.logs
        if state is self._state:
            return
        self._state = state
        self._take_in()
        self._tell()

    def tick(self) -> None:
        """Take in what the search has found meanwhile."""
        if self.display and self.is_mounted and self._take_in():
            self._tell()

    def _take_in(self) -> bool:
        """Show what was found; lines of the filter before stay until the search has something to show."""
        if self._view is None:
            self._view = self.console.view_logs(self._which)
        found = self._view.look()
        if found is self._found or not (len(found.numbers) or found.complete or found.problem):
            return False
        self._found = found
        self._list.exchange(found.numbers)
        if self._following:
            self._to_end()
        return True

    def _to_end(self) -> None:
        rows = self._list
        rows.cursor = max(0, rows.row_count() - 1)
        rows.scroll_to(y=max(0, rows.row_count() - rows.size.height), animate=False, force=True)

    def _search(self, which: LogFilter) -> None:
        """Filter anew, over everything that is kept."""
        self._which = which
        self._view = self.console.view_logs(which, self._view)
        self._found = None
        self._take_in()
        self._tell()

    def _tell(self) -> None:
        """Say what is shown of how much, by severity."""
        problem = self._found.problem if self._found else ""
        self.query_one("#log-status", Words).say(problem or self.status_text())

    def status_text(self) -> str:
        """The line below the log."""
        state, counts = self._state, self._state.counts
        parts = [f"{self._list.row_count()} of {state.end - state.first}"]
        if self._found is None or not self._found.complete:
            parts.append("searching")
        if not self._following:
            parts.append("paused, f follows")
        if self._which.words:
            parts.append(f"/{self._which.words}")
        if self._which.minimum:
            parts.append(f">= {self._which.minimum.name}")
        if self._which.hidden_nodes:
            parts.append("hidden: " + " ".join(sorted(self._which.hidden_nodes)))
        if state.dropped:
            parts.append(f"{state.dropped} dropped")
        parts += [f"{LETTERS[each]} {counts[each]}" for each in reversed(Severity) if counts.get(each)]
        return " · ".join(parts)

    def on_row_list_moved(self, event: RowList.Moved) -> None:
        """Follow while the cursor is on the newest line."""
        event.stop()
        following = event.index >= self._list.row_count() - 1
        if following is not self._following:
            self._following = following
            self._tell()

    def _record(self) -> LogRecord | None:
        return self.console.log(self._list.number(self._list.cursor))

    def action_follow(self) -> None:
        """Follow the newest line, or stop that."""
        self._following = not self._following
        if self._following:
            self._to_end()
        self._tell()

    def action_warnings(self) -> None:
        """Warnings and worse, or everything."""
        wanted = Severity.UNSET if self._which.minimum is Severity.WARN else Severity.WARN
        self._search(replace(self._which, minimum=wanted))

    def action_level(self) -> None:
        """The next minimum severity."""
        at = LEVELS.index(self._which.minimum) if self._which.minimum in LEVELS else 0
        self._search(replace(self._which, minimum=LEVELS[(at + 1) % len(LEVELS)]))

    def action_filter(self) -> None:
        """Ask for a filter."""
        self.ask(filter_line(self._which.words, self._filter))

    def _filter(self, words: str) -> None:
        self._search(replace(self._which, words=words))

    def action_exclude(self) -> None:
        """Hide the lines of this line's node."""
        record = self._record()
        if record is not None:
            self._search(replace(self._which, hidden_nodes=self._which.hidden_nodes | {record.node}))

    def action_clear_filter(self) -> None:
        """Show everything again."""
        self._search(LogFilter())

    def action_next_error(self) -> None:
        """To the next error, from the top again after the last."""
        rows = self._list
        now = rows.number(rows.cursor)
        errors = self.console.matching_logs(LogFilter(minimum=Severity.ERROR), 0)
        shown = (each for each in rotated(errors, now) if rows.number(rows.place(each)) == each)
        target = next(shown, None)
        if target is None:
            self.notify("No errors.")
        else:
            rows.cursor = rows.place(target)

    def action_detail(self) -> None:
        """Show the whole message."""
        record = self._record()
        if record is not None:
            self.host.push_screen(DetailScreen(record))

    def action_clear(self) -> None:
        """Clear the log."""
        self.console.clear_logs()
        self._search(self._which)

    def action_copy(self) -> None:
        """Copy the message through the terminal (OSC 52)."""
        record = self._record()
        if record is not None:
            self.host.copy_to_clipboard(record.text)
            self.notify("Copied.")

    def action_save(self) -> None:
        """Ask where to save."""
        self.ask_file("save these lines to", "log.txt", self._save)

    def _save(self, path: Path) -> str:
        records = (self.console.log(self._list.number(index)) for index in range(self._list.row_count()))
        lines = [
            f"[{each.severity.name}] [{each.stamp / 1e9:.9f}] [{each.node}]: {each.text}" for each in records if each
        ]
        save_file(path, "\n".join([*lines, ""]))
        return f"{len(lines)} lines saved to {path}"
