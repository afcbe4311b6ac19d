"""The log pane: every node's lines, filtered by severity and words, as many as there may be."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import chain
from pathlib import Path

from bot_console.tui import keymap
from bot_console.tui.console.model import ConsoleSnapshot, LogFilter, LogRecord, LogState, Severity
from bot_console.tui.console.protocol import Answer, Console, LogFindings, LogNumbers, LogView
from bot_console.tui.files.save_file import save_file
from bot_console.tui.format import LETTERS, clock_text, cut, harmless
from bot_console.tui.panes.list_pane import ListPane
from bot_console.tui.panes.logs.names import NodeNames
from bot_console.tui.screens.detail import DetailScreen
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
        self.names = NodeNames()

    def row_count(self) -> int:
        """How many lines there are."""
        return 0 if self.numbers is None else len(self.numbers)

    def number(self, index: int) -> int:
        """The number of the record on a line; -1 where there is none."""
        return self.numbers[index] if self.numbers is not None and 0 <= index < len(self.numbers) else -1

    def place(self, number: int) -> int:
        """The line of the record with that number, or of the next one that is shown."""
        return 0 if self.numbers is None else min(self.numbers.place(number), max(0, len(self.numbers) - 1))

    def shows(self, number: int) -> bool:
        """Whether the record with that number is among the lines."""
        return self.number(self.place(number)) == number

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
        return [Segment(line_text(record, self.names.of(record.node), width), style)]


def line_text(record: LogRecord, node: str, width: int) -> str:
    """A record on one line; the time is left out where there is little room. The end of a node's name says most."""
    time = f"{clock_text(record.stamp)} " if width >= 70 else ""
    node = harmless(node)
    node = "…" + node[1 - NODE :] if len(node) > NODE else node
    text = harmless(record.text[: 4 * width])
    return f"{time}{LETTERS[record.severity]} {cut(node, NODE, pad=True)} {text}"


def rotated(numbers: Sequence[int], now: int, step: int = 1) -> Iterator[int]:
    """Rising numbers, those above one of them first; with step -1 falling ones, those below it first."""
    if step > 0:
        at = bisect_right(numbers, now)
        return chain(numbers[at:], numbers[:at])
    at = bisect_left(numbers, now)
    return chain(reversed(numbers[:at]), reversed(numbers[at:]))


class LogsPane(ListPane):
    """Log lines of all nodes."""

    TITLE = "Logs"
    HELP = (
        "What the nodes log and print. The filter takes words (all must stand), !word (must not), node:name,\n"
        "sev:>=warn and re:pattern. Scrolling up stops following; nothing is lost meanwhile, f follows again."
    )
    BINDINGS = keymap.bindings("logs")

    def __init__(self, *args: object, **kwargs: object) -> None:
        super().__init__(*args, **kwargs)  # type: ignore[arg-type] -- handed on as they are
        self._state = LogState()
        self._which = LogFilter()
        self._view: LogView | None = None
        self._found: LogFindings | None = None
        self._following = True
        self._looked_for: int | None = None
        """The record that was gone to by what was looked for: to stand on it is to read, not to follow."""
        self._moment: int | None = None
        """The moment to go to as soon as its lines are there."""

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
        if self._list.names.learn(snapshot.graph):
            self._list.refresh()
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
        if self._moment is not None:
            self._to_moment(found)
        elif self._following:
            self._to_end()
        return True

    def _to_end(self) -> None:
        rows = self._list
        rows.cursor = max(0, rows.row_count() - 1)
        rows.scroll_to(y=max(0, rows.row_count() - rows.size.height), animate=False, force=True)

    def time_moved(self, stamp: int | None) -> None:
        """Go to the last line before a moment, as soon as it is there; follow the newest line again at None."""
        self._moment = stamp
        if stamp is None:
            self._following = True
            self._to_end()
        elif self._found is not None:
            self._to_moment(self._found)
        self._tell()

    def _to_moment(self, found: LogFindings) -> None:
        if self._moment is None or not len(found.numbers):
            return
        self._following = False
        self._list.cursor = self._place_of(found.numbers, self._moment)
        if found.complete:
            self._moment = None

    def _place_of(self, numbers: LogNumbers, stamp: int) -> int:
        """The line that was the newest one at a moment."""
        low, high = 0, len(numbers)
        while low < high:
            middle = (low + high) // 2
            record = self.console.log(numbers[middle])
            if record is None or record.stamp <= stamp:
                low = middle + 1
            else:
                high = middle
        return max(0, low - 1)

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
        # What was found may be newer than the snapshot: lines come all the time.
        end = max(state.end, self._found.end if self._found else 0)
        parts = [f"{self._list.row_count()} of {end - state.first}"]
        if self._found is None or not self._found.complete:
            parts.append("searching")
        if not self._following:
            parts.append("paused, f follows")
        if self._which.words:
            parts.append(f"/{self._which.words}")
        if self._which.minimum:
            parts.append(f">= {self._which.minimum.name}")
        if self._which.hidden_nodes:
            parts.append("hidden: " + " ".join(sorted(map(self._list.names.of, self._which.hidden_nodes))))
        if state.dropped:
            parts.append(f"{state.dropped} dropped")
        parts += [f"{LETTERS[each]} {counts[each]}" for each in reversed(Severity) if counts.get(each)]
        return " · ".join(parts)

    def on_row_list_moved(self, event: RowList.Moved) -> None:
        """Follow while the cursor is on the newest line."""
        event.stop()
        at_end = event.index >= self._list.row_count() - 1
        following = at_end and self._list.number(event.index) != self._looked_for
        if following is not self._following:
            self._following = following
            self._tell()

    def _record(self) -> LogRecord | None:
        return self.console.log(self._list.number(self._list.cursor))

    def action_follow(self) -> None:
        """Follow the newest line, or stop that."""
        self._following, self._looked_for = not self._following, None
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

    def filter_is(self, words: str) -> None:
        """Show the lines that pass."""
        self._search(replace(self._which, words=words))

    def stands_on_match(self, words: str) -> bool:
        """Every line that is shown matches the filter."""
        return True

    def find(self, words: str, step: int) -> bool:
        """The next line shown that matches, found over the whole log at once."""
        return self._go_to(LogFilter(words=words), step)

    def action_exclude(self) -> None:
        """Hide the lines of this line's node."""
        record = self._record()
        if record is not None:
            self._search(replace(self._which, hidden_nodes=self._which.hidden_nodes | {record.node}))

    def action_clear_filter(self) -> None:
        """Take all filters away."""
        self._which = LogFilter()
        super().action_clear_filter()

    def action_next_error(self) -> None:
        """To the next error, from the top again after the last."""
        if not self._go_to(LogFilter(minimum=Severity.ERROR), 1):
            self.notify("No errors.")

    def _go_to(self, which: LogFilter, step: int) -> bool:
        """The next of the lines shown that pass a filter, or the one before; whether there is any."""
        rows = self._list
        there = self.console.matching_logs(which, 0)
        shown = (each for each in rotated(there, rows.number(rows.cursor), step) if rows.shows(each))
        target = next(shown, None)
        if target is not None:
            self._looked_for, self._following = target, False
            rows.cursor = rows.place(target)
            self._tell()
        return target is not None

    def action_detail(self) -> None:
        """Show the whole message."""
        record = self._record()
        if record is not None:
            self.host.push_screen(DetailScreen(replace(record, node=self._list.names.of(record.node))))

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

    def _save(self, path: Path) -> Answer:
        records = (self.console.log(self._list.number(index)) for index in range(self._list.row_count()))
        lines = [
            f"[{each.severity.name}] [{each.stamp / 1e9:.9f}] [{self._list.names.of(each.node)}]: {each.text}"
            for each in records
            if each
        ]
        save_file(path, "\n".join([*lines, ""]))
        return Answer(True, f"{len(lines)} lines saved to {path}")
