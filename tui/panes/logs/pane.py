"""The log pane: every node's lines, filtered by severity and words, however many there are."""

from __future__ import annotations

import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

from bot_console.tui import keymap
from bot_console.tui.console.answer import Answer
from bot_console.tui.console.logs.port import LogFindings, LogSource, LogView
from bot_console.tui.console.model import ConsoleSnapshot, LogFilter, LogState, Severity
from bot_console.tui.files.save_file import save_file
from bot_console.tui.format import SEVERITY_CHARACTERS
from bot_console.tui.panes.logs.filtering import Filtering
from bot_console.tui.panes.logs.levels_screen import LevelsScreen
from bot_console.tui.panes.logs.line_pane import LinePane
from bot_console.tui.panes.logs.match_search import MatchSearch
from bot_console.tui.panes.logs.names import NodeNames
from bot_console.tui.panes.logs.rows import LogRows
from bot_console.tui.panes.logs.rules import RuleBook
from bot_console.tui.panes.logs.rules_screen import RulesScreen
from bot_console.tui.panes.logs.severity_strip import SeverityStrip
from bot_console.tui.panes.logs.similar_lines import options_like
from bot_console.tui.panes.logs.source import LiveLog
from bot_console.tui.text.sanitize import sanitize
from bot_console.tui.widgets.picture import Picture
from bot_console.tui.widgets.placeholder import FILTERED_OUT, Placeholder
from bot_console.tui.widgets.prompt.common import filter_problem, path_problem
from bot_console.tui.widgets.prompt.line import Prompt
from bot_console.tui.widgets.prompt.question import Choice, Line
from bot_console.tui.widgets.row_list import RowList
from bot_console.tui.widgets.static_text import StaticText
from textual.app import ComposeResult

EMPTY = Placeholder(
    "Everything that nodes log and print is shown here; there is nothing yet.",
    (("8", "Start nodes"), ("O", "Read a saved log"), ("?", "Help")),
)
COMPACT_LINES = 6
"""Minimum height (lines) at which the pane has a status line below the log; otherwise it is in the border."""
STRIP_LINES = 16
"""Minimum height (lines) at which the pane shows when warnings and errors were logged."""


class LogsPane(LinePane):
    """Log lines of all nodes, or those of a file."""

    TITLE = "Logs"
    HELP = (
        "What the nodes log and print. A filter takes words (all must match), !word (must not match), node:name,\n"
        "sev:>=warn, at:file.py:12, time:14:03..14:05, time:-5m and re:pattern. s searches and hides nothing; n and N\n"
        "go to the next and the previous match. x hides lines like the one at the cursor, + highlights them: both are\n"
        "rules that are kept, and F lists them. Scrolling up stops following; no line is lost meanwhile, and f\n"
        "follows again."
    )
    BINDINGS = keymap.bindings("logs")

    clock: Callable[[], float] = staticmethod(time.monotonic)
    """A monotonic clock (s), replaced in tests."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._source: LogSource = LiveLog(self.console)
        self._names = NodeNames()
        self._state = LogState()
        self._filtering = Filtering(RuleBook())
        self._view: LogView | None = None
        self._found: LogFindings | None = None
        self._match_search = MatchSearch(self._view_of)
        self._sought_for = ""
        """The target of the search, as shown to the user."""
        self._searched_for: int | None = None
        """The number of the record found by a search: with the cursor on it the user reads, so the log is not followed,
        even if it is the newest.
        """
        self._moment: int | None = None
        """The moment (ns since the epoch) to go to as soon as its lines have been found."""
        self._followed_to = 0
        """The number of the first record that arrived after the newest line was last followed."""
        self._strip = SeverityStrip()

    def _view_of(self, which: LogFilter, before: LogView | None) -> LogView:
        return self._source.view(which, before)

    def compose(self) -> ComposeResult:
        """The strip of warnings and errors, the lines, the status, and a prompt."""
        yield Picture(id="log-strip")
        yield LogRows(self._source, self._filtering.rules, self._names)
        yield StaticText(id="log-status")
        yield Prompt(id="log-prompt")

    def on_mount(self) -> None:
        """Read the user's rules."""
        super().on_mount()
        rules = self._filtering.rules
        rules.read()
        for each in rules.problems:
            self.notify(each, severity="warning")

    def on_unmount(self) -> None:
        """Close the log file, if one is open."""
        super().on_unmount()
        self._source.close()

    def focus_target(self) -> None:
        """Focus the lines."""
        self._list.focus()

    def observe(self, snapshot: ConsoleSnapshot) -> None:
        """Learn node names, as a node may leave before its lines are shown, and count new warnings and errors."""
        self._strip.take(snapshot.logs.counts, self.clock())
        if self._names.learn(snapshot.graph) and self.has_parts:
            self._list.refresh()

    def show(self, snapshot: ConsoleSnapshot) -> None:
        """Show what is new in the log."""
        self.observe(snapshot)
        state = self._source.state if self._source.name else snapshot.logs
        if state is self._state:
            return
        self._state = state
        self._show_found()
        self._report()

    def tick(self) -> None:
        """Show what the search has found since the last tick, and new lines of a file."""
        if not self.display:
            return
        self._draw_strip()
        changed = False
        if self._source.name:  # the log of the system comes with the snapshot
            state = self._source.state
            changed, self._state = state is not self._state, state
        if self._show_found() or self._finish_seek() or changed:
            self._report()

    def _show_found(self) -> bool:
        """Show the lines found; the lines of the previous filter stay until there is something to show."""
        if self._view is None:
            self._view = self._source.view(self._filtering.log_filter())
        found = self._view.poll()
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
        """Go to the last line before a moment as soon as it is found; for None, follow the newest line again."""
        self._moment = stamp
        if self.is_ending:
            return
        if stamp is None:
            self._following = True
            self._to_end()
        elif self._found is not None:
            self._to_moment(self._found)
        self._report()

    def _to_moment(self, found: LogFindings) -> None:
        if self._moment is None or not len(found.numbers):
            return
        self._following = False
        self._list.cursor = self._list.place_at(self._moment)
        if found.complete:
            self._moment = None

    def _search(self) -> None:
        """Search all stored lines with the current filter."""
        self._view = self._source.view(self._filtering.log_filter(), self._view)
        self._found = None
        self._show_found()
        self._list.refresh()
        self._report()

    def _draw_strip(self) -> None:
        """Show when warnings and errors of the running system were logged, if there is room."""
        strip, now, width = self.query_one("#log-strip", Picture), self.clock(), self.content_size.width
        if not self._strip.is_changed(
            now, width, is_shown := self.size.height >= STRIP_LINES and not self._source.name
        ):
            return
        lines = self._strip.lines(now, width) if is_shown else []
        strip.styles.height = len(lines)
        strip.display = bool(lines)
        strip.set_lines(lines)

    def _report(self) -> None:
        """Update the status text."""
        problem = self._found.problem if self._found else ""
        if self._following and self._found:
            self._followed_to = self._found.end
        text = problem or self.status_text()
        self._list.show_placeholder(FILTERED_OUT if self._filtering.texts() else EMPTY)
        self.caption(text if self.has_class("compact") else "")
        self.query_one("#log-status", StaticText).show_or_hide(text)

    def on_resize(self) -> None:
        """Move the status text into the border if the pane is low."""
        compact = 0 < self.size.height < COMPACT_LINES
        if compact is not self.has_class("compact"):
            self.set_class(compact, "compact")
            self._report()
        if self.has_parts:
            self._draw_strip()

    def status_text(self) -> str:
        """The line below the log; empty as long as there is nothing to count."""
        state, counts = self._state, self._state.counts
        # The search may have seen newer lines than the snapshot.
        end = max(state.end, self._found.end if self._found else 0)
        if end == state.first and not state.dropped and not self._filtering.texts():
            return ""
        parts = [f"{self._list.row_count()} of {end - state.first}"]
        if self._found is None or not self._found.complete or self._match_search.under_way:
            parts.append("searching")
        if not self._following:
            new = self._new_below()
            parts.append(f"paused, {new} new below, f follows" if new else "paused, f follows")
        if self._searched_for is not None and self._sought_for:
            parts.append(f"{self._match_search.text()} {self._sought_for}")
        parts += [*self._filtering.texts(), *([] if self._filtering.folded else ["repeats shown"])]
        if state.dropped:
            parts.append(f"{state.dropped} dropped")
        parts += [f"{SEVERITY_CHARACTERS[each]} {counts[each]}" for each in reversed(Severity) if counts.get(each)]
        return " · ".join(parts)

    def _new_below(self) -> int:
        """The number of lines shown that have arrived since the newest one was last followed."""
        if self._found is None:
            return 0
        return len(self._found.numbers) - self._found.numbers.place(self._followed_to)

    def on_row_list_moved(self, event: RowList.Moved) -> None:
        """Follow while the cursor is on the newest line."""
        event.stop()
        at_end = event.index >= self._list.row_count() - 1
        following = at_end and self._list.number(event.index) != self._searched_for
        if following is not self._following:
            self._following = following
            self._report()

    def action_follow(self) -> None:
        """Follow the newest line, or stop following it."""
        self._following, self._searched_for = not self._following, None
        if self._following:
            self._to_end()
        self._report()

    def action_warnings(self) -> None:
        """Switch between warnings and worse, and everything."""
        self._filtering.toggle_warnings()
        self._search()

    def action_level(self) -> None:
        """Switch to the next minimum severity."""
        self._filtering.next_level()
        self._search()

    def action_fold(self) -> None:
        """Switch between folding consecutive equal lines and showing each of them."""
        self._filtering.folded = not self._filtering.folded
        self._search()

    def action_suspend_filters(self) -> None:
        """Suspend the filters, or restore them."""
        filtering = self._filtering
        if not filtering.off and not filtering.texts():
            self.notify("Nothing is filtered; / filters, x hides lines like this one.")
            return
        filtering.off = not filtering.off
        self._search()

    def action_only_highlighted(self) -> None:
        """Switch between highlighted lines only and everything."""
        filtering = self._filtering
        if not filtering.only_highlighted and not filtering.rules.highlighted:
            self.notify("No rule highlights anything; + highlights lines like this one.")
            return
        filtering.only_highlighted, filtering.off = not filtering.only_highlighted, False
        self._search()

    def apply_filter(self, words: str) -> None:
        """Show the lines that pass the filter."""
        self._filtering.words, self._filtering.off = words, False
        self._search()

    def action_clear_filter(self) -> None:
        """Return the time cursor to now; if it is there already, clear words and severity."""
        if self.time_cursor.stamp is not None:
            self.time_cursor.move(None, self)
            self.time_moved(None)
            return
        self._filtering.clear()
        self._searched_for = None
        super().action_clear_filter()

    def action_alike(self, hide: bool) -> None:
        """Ask what lines like the one at the cursor have in common, and add a rule that hides or highlights them."""
        record = self._list.record
        if record is None:
            return
        label = "Hide lines like this one, by" if hide else "Highlight lines like this one, by"
        find = partial(options_like, record, self._list.names.of(record.node))
        self.ask(Choice(label, lambda words: self._add_rule(words, hide=hide), find=find))

    def _add_rule(self, words: str, *, hide: bool) -> None:
        rule, problem = self._filtering.rules.add(words, hide=hide)
        self._filtering.off = False
        self._search()
        did = f"{'Hidden' if hide else f'In {rule.colour}'}: {words}\nF shows the rules, t everything."
        self.notify(problem or did, severity="warning" if problem else "information")

    def action_rules(self) -> None:
        """Open the screen that edits the rules."""
        self.host.push_screen(RulesScreen(self._filtering.rules, self._search))

    def action_levels(self) -> None:
        """Open the screen that shows and sets logger levels."""
        self.host.push_screen(LevelsScreen(self.console, self.console.snapshot().graph))

    def is_on_match(self, words: str) -> bool:
        """True: every line shown matches the filter."""
        return True

    def action_search(self) -> None:
        """Ask for words to search for; nothing is hidden."""
        self.ask(Line("search", self._search_for, text=self._sought, check=filter_problem))

    def _search_for(self, words: str) -> None:
        """Go to the newest match if the newest line is followed, otherwise to the next one."""
        if words:
            self._sought = words
            self.find(words, -1 if self._following else 1)

    def find(self, words: str, step: int) -> bool:
        """Search the whole log in the background for the next shown line that matches; always returns True."""
        return self._seek(words, Severity.UNSET, step)

    def action_next_error(self) -> None:
        """Go to the next error; after the last one, start again from the top."""
        self._seek("", Severity.ERROR, 1)

    def _seek(self, words: str, minimum: Severity, step: int) -> bool:
        rows = self._list
        # When searching upwards from the end of the log, the line at the cursor may be the match.
        whole = step < 0 and self._following
        at = rows.number(rows.cursor) + whole if step > 0 or whole else rows.first_of_row()
        self._sought_for = words or "errors"
        self._match_search.seek(self._filtering.narrowed_to(words, minimum), at, step)
        self._finish_seek()
        self._report()
        return True

    def _finish_seek(self) -> bool:
        """Go to the line that the search has found; returns whether the search has ended."""
        target = self._match_search.poll()
        if target is None:
            return False
        if target < 0:
            self.notify(f"Nothing here matches {self._sought_for}", severity="warning")
        else:
            self._searched_for, self._following, self._moment = target, False, None
            self._list.cursor = self._list.place(target)
        return True

    def action_open_file(self) -> None:
        """Ask for a saved log to read; if one is shown, go back to the log of the running system."""
        if self._source.name:
            self._read(LiveLog(self.console))
        else:
            self.ask(Line("read the log file", self._open, text="log.txt", check=path_problem))

    def _open(self, path: str) -> None:
        try:
            self._read(self.console.logs.open(path.strip()))
        except ValueError as error:
            self.notify(str(error), severity="error")

    def _read(self, source: LogSource) -> None:
        """Show another log with the same filter."""
        self._source.close()
        self._source = self._list.source = source
        self.border_title = f"Logs of {sanitize(Path(source.name).name)} · O goes back" if source.name else self.TITLE
        self._state, self._view, self._found = LogState(), None, None
        self._match_search.forget()
        self._following, self._searched_for, self._moment, self._followed_to = True, None, None, 0
        self._list.show_nothing()
        self._state = source.state
        self._search()

    def action_clear(self) -> None:
        """Clear the log."""
        self._source.clear()
        self._match_search.forget()
        self._search()

    def action_save(self) -> None:
        """Ask for the file to save the shown lines to."""
        self.ask_file("save these lines to", "log.txt", self._save)

    def _save(self, path: Path) -> Answer:
        lines = self._list.saved_lines()
        save_file(path, "\n".join([*lines, ""]))
        return Answer(True, f"{len(lines)} lines saved to {path}")
