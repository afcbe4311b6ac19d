"""The alarms pane: conditions over topics and parameters, evaluated all the time and announced when they come true."""

from __future__ import annotations

import re
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from typing import Any

from bot_console.tui import keymap
from bot_console.tui.console.model import ConsoleSnapshot, RateCheck
from bot_console.tui.panes.alarms.alarm import Alarm, AlarmText, alarm_texts_in
from bot_console.tui.panes.alarms.condition import parse_condition
from bot_console.tui.panes.alarms.rows import AlarmRows, alarm_row, check_row, suggestion_row
from bot_console.tui.panes.alarms.templates import templates
from bot_console.tui.panes.list_pane import ListPane
from bot_console.tui.text.redraw_interval import is_due
from bot_console.tui.widgets.placeholder import FILTERED_OUT, Placeholder
from bot_console.tui.widgets.prompt.line import Prompt
from bot_console.tui.widgets.prompt.question import Line
from bot_console.tui.widgets.row_list import RowList
from bot_console.tui.widgets.static_text import StaticText
from textual.app import ComposeResult

REQUESTER, SUGGESTING = "alarms", "alarms suggested"
STATE_NAME = "alarms"
SAMPLE_POLL_S, LIST_POLL_S, MISSING_PATH_POLL_S = 0.2, 1.0, 1.0
"""Seconds between two polls of the samples, two updates of the list, and two tries to watch a missing path."""
NOTICE_S = 8.0
"""Seconds for which a notice is shown; an alarm that becomes active again meanwhile is counted in its next notice."""
MAX_ALARMS = 100
"""Maximum number of alarms."""
EXAMPLE = "/battery/percentage < 0.2"
NAMED = re.compile(r"([^/<>=()]+?):\s+(.+)")
"""A name, a colon, blanks and a condition."""

UNNAMED: Mapping[str, str] = {"alarms.edit": "", "alarms.delete": "", "alarms.bell": ""}
SUGGESTED_KEYS: Mapping[str, str] = {**UNNAMED, "alarms.edit": "Watch"}
NO_ALARM = "This is an expected rate, not an alarm."
EXPECTED = "Expected by a file, a profile or a monitor; E in Topics names the file."

EMPTY = Placeholder(
    "An alarm watches a condition over topics and parameters and says when it becomes true.",
    (("a", f"Add an alarm, such as  low battery: {EXAMPLE}"), ("9", "Topics that can be watched"), ("?", "Help")),
)
HINT = "Nothing is watched yet: Enter watches one of these, a adds your own."


class AlarmsPane(ListPane):
    """Watched conditions."""

    TITLE = "Alarms"
    HELP = (
        "Conditions over fields of topics and parameters, such as  low battery: /battery/percentage < 0.2  or\n"
        "/scan/ranges[0] < 0.4 and /odom/twist.twist.linear.x > 1, or over rates: rate(/scan) < 8. While there are\n"
        "none, some are suggested, and Enter adds one. Alarms are evaluated with each message, whichever\n"
        "pane is visible; you are notified when one becomes active, with the terminal's bell if b turned it on.\n"
        "They are kept for the next start. Topics whose rates are expected (E in Topics) are listed first."
    )
    BINDINGS = keymap.bindings("alarms")

    clock: Callable[[], float] = staticmethod(time.monotonic)
    """A monotonic clock (s); tests replace it with one that they step."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._alarms: list[Alarm] = []
        self._holding: list[str] = []
        """The names of the active alarms that `AlarmsHold` reported last."""
        self._waiting: dict[str, str] = {}
        """Paths that cannot be watched yet, and why."""
        self._checks: Sequence[RateCheck] = ()
        """The topics whose rates are expected."""
        self._polled = self._drawn = self._asked = float("-inf")
        self._suggested: list[Alarm] = []
        """The suggestions, shown while there is no alarm; their paths are watched only while the pane is visible."""

    def compose(self) -> ComposeResult:
        """The alarms, details of the one at the cursor, and a prompt."""
        yield StaticText(id="alarms-hint")
        yield AlarmRows()
        yield StaticText(id="alarms-status")
        yield Prompt(id="alarms-prompt")

    def on_mount(self) -> None:
        """Restore the alarms of the last run."""
        for text in alarm_texts_in(self.state_store.get(STATE_NAME))[:MAX_ALARMS]:
            self._alarms.append(Alarm.of(text))
            self._waiting |= dict.fromkeys(self._alarms[-1].paths, "not watched yet")

    @property
    def _list(self) -> AlarmRows:
        return self.query_one(AlarmRows)

    @property
    def key_words(self) -> Mapping[str, str]:
        """Hide the keys that do not apply to the row at the cursor; on a suggestion, Enter is labelled Watch."""
        row = self._list.current if self.has_parts else None
        if row is not None and row.suggested:
            return SUGGESTED_KEYS
        return {} if row is not None and not row.expected else UNNAMED

    def show(self, snapshot: ConsoleSnapshot) -> None:
        """Redraw the list if the expected rates or suggestions have changed, otherwise once per `LIST_POLL_S`."""
        before = self._checks, self._suggested
        self._checks = snapshot.rate_checks
        self._suggest(() if self._alarms or self._checks else templates(snapshot.graph.topics))
        is_changed = self._checks is not before[0] or self._suggested is not before[1]
        if is_changed or is_due(self._drawn, self.clock(), LIST_POLL_S):
            self._arrange()

    def _suggest(self, texts: Sequence[AlarmText]) -> None:
        """Suggest these alarms, and watch exactly the paths that they need."""
        before = {each.text: each for each in self._suggested}
        if list(before) == list(texts):
            return
        self._suggested = [before.get(each) or Alarm.of(each) for each in texts]
        old, new = _paths(before.values()), _paths(self._suggested)
        for path in old - new:
            self.console.plots.unwatch(path, SUGGESTING)
        for path in new - old:
            answer = self.console.plots.watch(path, SUGGESTING)
            for each in self._suggested if not answer.ok else ():
                each.problem = answer.text if path in each.paths else each.problem

    def tick(self) -> None:
        """Process new samples, even while hidden, and update the list while it is visible."""
        now = self.clock()
        if self._alarms and now - self._polled >= SAMPLE_POLL_S:
            self._polled = now
            if self._waiting and now - self._asked >= MISSING_PATH_POLL_S:
                self._asked = now
                self._watch(self._waiting)
            for alarm in self._alarms:
                began = alarm.poll(self.console.plots)
                if began and alarm.text.bell:
                    self.host.bell()
                alarm.unreported += began
                if alarm.unreported and now - alarm.reported >= NOTICE_S:
                    self._report(alarm, alarm.unreported[-1], len(alarm.unreported))
                    alarm.reported, alarm.unreported = now, []
        if self._suggested and not self.display:
            self._suggest(())
        holding = [each.text.name for each in self._alarms if each.holds]
        if holding != self._holding:
            self._holding = holding
            self.post_message(self.AlarmsHold(holding))
        if self.display and is_due(self._drawn, now, LIST_POLL_S):
            self._arrange()

    def _watch(self, paths: Any) -> None:
        for path in tuple(paths):
            answer = self.console.plots.watch(path, REQUESTER)
            if answer.ok:
                self._waiting.pop(path, None)
            else:
                self._waiting[path] = answer.text

    def _report(self, alarm: Alarm, value: float, times: int) -> None:
        often = f" ({times} times)" if times > 1 else ""
        self.notify(
            f"{alarm.text.name}: {value:.4g}{often}\n{alarm.text.condition}",
            title="Alarm",
            severity="warning",
            timeout=NOTICE_S,
        )

    def _arrange(self) -> None:
        self._drawn = self.clock()
        now = self.console.plots.time()
        for alarm in self._alarms:
            waits = next((self._waiting[each] for each in alarm.paths if each in self._waiting), "")
            alarm.problem = waits or alarm.problem
        every = [check_row(each, time.time()) for each in self._checks]
        every += [alarm_row(each, now) for each in self._alarms]
        for each in self._suggested:
            each.poll(self.console.plots)
            every.append(suggestion_row(each))
        shown = [each for each in every if self._query.matches(f"{each.name} {each.condition}")]
        self._list.exchange(shown)
        holding = sum(each.holds is True for each in every)
        self.report_filter(len(shown), len(every), f"{holding} of {len(every)} active" if holding else "")
        self._describe()

    def _describe(self) -> None:
        alarm = self._current
        self._list.show_placeholder(FILTERED_OUT if self._alarms or self._checks or self._suggested else EMPTY)
        hint = self.query_one("#alarms-hint", StaticText)
        hint.display = bool(self._suggested)
        hint.show_text(HINT if self._suggested else "")
        if alarm is None:
            text = EXPECTED if self._is_expected else ""
        else:
            values = "  ".join(f"{each} = {alarm.values[each]:.4g}" for each in alarm.paths if each in alarm.values)
            text = alarm.problem or values or "no value yet"
        self.query_one("#alarms-status", StaticText).show_text(text)
        self.keys_changed()

    @property
    def _current(self) -> Alarm | None:
        row = self._list.current
        return next((each for each in self._alarms if row and not row.expected and each.text.name == row.name), None)

    @property
    def _is_expected(self) -> bool:
        """Whether an expected rate is at the cursor."""
        return self._list.current is not None and self._list.current.expected

    def on_row_list_moved(self, event: RowList.Moved) -> None:
        """Describe the alarm at the cursor."""
        event.stop()
        self._describe()

    def on_alarm_rows_pressed(self, event: AlarmRows.Pressed) -> None:
        """Edit the alarm whose selected row was clicked."""
        event.stop()
        self.action_edit()

    def action_add(self) -> None:
        """Ask for a new alarm."""
        if len(self._alarms) >= MAX_ALARMS:
            self.notify(f"There are {MAX_ALARMS} alarms; d deletes one.", severity="warning")
            return
        self._ask("alarm", "", None)

    def action_edit(self) -> None:
        """Edit the alarm at the cursor."""
        alarm, row = self._current, self._list.current
        if self._is_expected:
            self.notify(NO_ALARM, severity="warning")
        elif row is not None and row.suggested:
            self._take(None, f"{row.name}: {row.condition}")
        elif alarm is None:
            self.action_add()
        else:
            self._ask("alarm", f"{alarm.text.name}: {alarm.text.condition}", alarm)

    def _ask(self, label: str, text: str, old: Alarm | None) -> None:
        # A prompt with suggestions does not select the old text: usually its end is edited.
        suggestions = self.console.plots.plottable()
        check, then = partial(self._wrong, old), partial(self._take, old)
        self.ask(Line(label, then, text=text, check=check, suggestions=suggestions))

    def _wrong(self, old: Alarm | None, typed: str) -> str:
        name, condition = split_name(typed)
        try:
            parse_condition(condition)
        except ValueError as error:
            return str(error)
        taken = any(each.text.name == name and each is not old for each in self._alarms)
        return f"there is already an alarm '{name}'" if taken else ""

    def _take(self, old: Alarm | None, typed: str) -> None:
        name, condition = split_name(typed)
        alarm = Alarm.of(AlarmText(name, condition, old is not None and old.text.bell))
        if old in self._alarms:
            self._alarms[self._alarms.index(old)] = alarm
        else:
            self._alarms.append(alarm)
        self._watch(alarm.paths)
        self._suggest(())
        self._release(old)
        self._keep()
        names = [each.name for each in self._list.rows]
        self._list.cursor = names.index(name) if name in names else self._list.cursor

    def _release(self, alarm: Alarm | None) -> None:
        """Stop watching the paths that no other alarm uses."""
        wanted = {path for each in self._alarms for path in each.paths}
        for path in set(alarm.paths) - wanted if alarm else ():
            self._waiting.pop(path, None)
            self.console.plots.unwatch(path, REQUESTER)

    def _keep(self) -> None:
        why = self.state_store.put(STATE_NAME, [each.text.data for each in self._alarms])
        if why:
            self.notify(f"The alarms are not saved: {why}", severity="warning")
        self._arrange()

    def action_delete(self) -> None:
        """Delete the alarm at the cursor."""
        alarm = self._current
        if self._is_expected:
            self.notify(NO_ALARM, severity="warning")
        if alarm is not None:
            self._alarms.remove(alarm)
            self._release(alarm)
            self._keep()

    def action_bell(self) -> None:
        """Turn the terminal bell on or off for the alarm at the cursor."""
        alarm = self._current
        if alarm is not None:
            alarm.text = AlarmText(alarm.text.name, alarm.text.condition, not alarm.text.bell)
            self._keep()

    def action_plot(self) -> None:
        """Plot the paths of the alarm at the cursor."""
        for path in self._current.paths if self._current else ():
            self.post_message(self.PlotWanted(path))

    def detach(self) -> None:
        """Stop watching all paths."""
        self._suggest(())
        for path in _paths(self._alarms):
            self.console.plots.unwatch(path, REQUESTER)


def _paths(alarms: Iterable[Alarm]) -> set[str]:
    return {path for each in alarms for path in each.paths}


def split_name(typed: str) -> tuple[str, str]:
    """Split a typed text into name and condition; without a name the condition serves as one."""
    found = NAMED.fullmatch(typed.strip())
    condition = " ".join((found[2] if found else typed).split())
    return (found[1].strip() if found else condition), condition
