"""The topics pane: topics with their rates and live messages, publishing, service calls and action goals."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

from bot_console.tui import keymap
from bot_console.tui.console.model import ConsoleSnapshot, GraphInfo, RateCheck
from bot_console.tui.console.topics.port import LiveMessage, RequestedQos
from bot_console.tui.files.save_file import typed_path
from bot_console.tui.panes.list_pane import ListPane
from bot_console.tui.panes.topics.message import MessageRows
from bot_console.tui.panes.topics.qos_form import changed_qos, qos_fields, qos_problem, silence_reason
from bot_console.tui.panes.topics.rows import Kind, Row, group_by_namespace, initial_folds, matches, rows
from bot_console.tui.panes.topics.table import TopicRows, heading
from bot_console.tui.text.counted import counted
from bot_console.tui.text.figures import age_text, rate_text
from bot_console.tui.text.redraw_interval import is_due
from bot_console.tui.widgets.placeholder import FILTERED_OUT, Placeholder
from bot_console.tui.widgets.prompt.common import path_problem
from bot_console.tui.widgets.prompt.line import Prompt
from bot_console.tui.widgets.prompt.question import Choice, Fill, Form, Line, Option, matching_options
from bot_console.tui.widgets.row_list import RowList
from bot_console.tui.widgets.static_text import StaticText
from textual.app import ComposeResult
from textual.containers import Container

MEASURE_POLL_S = 1.0
"""Seconds between two polls of the measurements."""
MESSAGE_POLL_S = 0.25
"""Seconds between two polls of the open message."""
EXPECTED_FILE = "expected-rates-file"
MAX_STATE_LINES = 3
MIN_SIDE_BY_SIDE_CELLS = 110
"""Minimum width (cells) at which the list and the message are shown side by side."""


class TopicsPane(ListPane):
    """Topics, services and actions."""

    TITLE = "Topics"
    HELP = (
        "Every topic with its publishers and subscribers, rate, bandwidth, age and value of the newest message,\n"
        "latency by header stamps, type and offered QoS. Only visible rows are measured, and only while the pane is\n"
        "visible. Enter opens a namespace, or the newest message as a tree that keeps updating. P fills in a message\n"
        "and publishes it. m lists services and actions, which Enter calls. ! marks a faulty topic. E names a file of\n"
        "expected rates (`bot-console graph --rates` writes one); late topics are marked, too."
    )
    BINDINGS = keymap.bindings("topics")

    clock: Callable[[], float] = staticmethod(time.monotonic)
    """A monotonic clock (s); tests replace it with one that they step."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._info: GraphInfo | None = None
        self._problem = ""
        self._checks: Sequence[RateCheck] = ()
        self._kind = Kind.TOPICS
        self._every = self._listed = 0
        self._hidden = False
        self._folded: frozenset[str] | None = None
        """The namespaces that the user has folded; None until the user folds or unfolds one."""
        self._folded_matches: frozenset[str] = frozenset()
        """The namespaces that have been folded since the filter was set."""
        self._measuring: list[str] = []
        self._topic = ""
        """The topic whose message is open."""
        self._qos: dict[str, RequestedQos] = {}
        """The QoS of subscriptions that differs from the offered one, by topic."""
        self._shown = LiveMessage()
        self._frozen = False
        self._polled = self._message_polled_at = 0.0

    def compose(self) -> ComposeResult:
        """The headings, the list and the message, a status line on the row at the cursor, and a prompt."""
        yield StaticText(id="topics-heading")
        with Container(id="topics-body"):
            yield TopicRows()
            with Container(id="topics-message"):
                yield StaticText(id="message-state")
                yield MessageRows()
        yield StaticText(id="topics-status")
        yield Prompt(id="topics-prompt")

    @property
    def key_words(self) -> Mapping[str, str]:
        """What Enter does; keys that only apply to topics are hidden while services or actions are listed."""
        if self._kind is Kind.TOPICS:
            return {}
        for_topics = dict.fromkeys(("topics.fill", "topics.plot", "topics.freeze"), "")
        do = "Call" if self._kind is Kind.SERVICES else "Send a goal"
        if not self._listed or self.console.snapshot().capabilities.change:
            do = ""
        return {**for_topics, "topics.open": do, "topics.kind": _next(self._kind).value.capitalize()}

    @property
    def _list(self) -> TopicRows:
        return self.query_one(TopicRows)

    @property
    def _message(self) -> MessageRows:
        return self.query_one(MessageRows)

    @property
    def _in_message(self) -> bool:
        """Whether keys act on the message rather than on the list."""
        return bool(self._topic) and (self._message.has_focus or not self._list.display)

    def focus_target(self) -> None:
        """Focus the message if one is open, otherwise the list."""
        (self._message if self._topic else self._list).focus()

    def show(self, snapshot: ConsoleSnapshot) -> None:
        """Update the list if the graph is a different object; measurements are polled no more often than in `tick`."""
        is_arranged = snapshot.graph is not self._info or snapshot.problem != self._problem
        if is_arranged:
            self._info, self._problem = snapshot.graph, snapshot.problem
            self._arrange()
        if snapshot.rate_checks is not self._checks:
            self._checks = snapshot.rate_checks
            self._list.checks = {each.topic: each for each in self._checks}
        now = self.clock()
        if is_arranged or is_due(self._polled, now, MEASURE_POLL_S):
            self._poll(now)

    def _arrange(self) -> None:
        shown = self._list
        shown.kind = self._kind
        every = rows(self._info or GraphInfo(), self._kind, hidden=self._hidden)
        self._every = len(every)
        found = [each for each in every if matches(self._query, each)]
        shown.exchange(group_by_namespace(found, self._folds(every)))
        self._listed = len(found)
        self.keys_changed()
        self._head()
        self._report()

    def _folds(self, every: Sequence[Row]) -> frozenset[str]:
        """The namespaces that are folded now."""
        if self._query.terms:
            return self._folded_matches
        return initial_folds(every) if self._folded is None else self._folded

    @property
    def _current(self) -> Row | None:
        """The topic, service or action at the cursor; None on a namespace."""
        row = self._list.current
        return None if row is None or row.members else row

    def _head(self) -> None:
        shown = self._list
        if shown.across:
            self.query_one("#topics-heading", StaticText).show_text(heading(shown.columns(shown.across), self._kind))

    def tick(self) -> None:
        """Measure the visible rows and update them; while the pane is hidden, measure nothing."""
        if not self.display:
            if self._measuring:
                self._measure([])
            if self._message_polled_at:
                self._message_polled_at = 0.0
                self.console.topics.listen("")
            return
        now = self.clock()
        if is_due(self._polled, now, MEASURE_POLL_S):
            self._poll(now)
        if self._topic and is_due(self._message_polled_at, now, MESSAGE_POLL_S):
            self._poll_message(now)

    def go_to(self, name: str) -> None:
        """Put the cursor on a topic."""
        if self._kind is not Kind.TOPICS:
            self._kind, self.border_title = Kind.TOPICS, self.TITLE
            self.post_message(self.KeysChanged())
        self.set_filter("")
        space = next((each.name for each in self._list.rows if each.is_folded and name in each.members), "")
        if space:
            self._fold(space, closed=False)
        names = ["" if each.members else each.name for each in self._list.rows]
        if name in names:
            self._list.cursor = names.index(name)

    def detach(self) -> None:
        """Stop measuring and listening."""
        self._measure([])
        self.console.topics.listen("")

    def _measure(self, topics: list[str]) -> None:
        if topics != self._measuring:
            self._measuring = topics
            self.console.topics.measure(topics, "topics")

    def _poll(self, now: float) -> None:
        """Show the measurements, and measure the rows that are visible now."""
        self._polled = now
        shown, traffic = self._list, self.console.topics
        self._measure(shown.in_view if self._kind is Kind.TOPICS and shown.display else [])
        if self._kind is Kind.TOPICS:
            shown.show_measured(traffic.measured(), traffic.repeated(), traffic.newest())
        elif self._kind is Kind.ACTIONS:
            goals = traffic.goals()
            if {n: g.active for n, g in goals.items()} != {n: g.active for n, g in shown.goals.items()}:
                shown.refresh()
            shown.goals = goals
        self._report()

    def _poll_message(self, now: float) -> None:
        """Show the newest message, or while frozen, how many have arrived since."""
        if not self._message_polled_at:
            self.console.topics.listen(self._topic, self._qos.get(self._topic))
        self._message_polled_at = now
        heard = self.console.topics.heard()
        if heard.topic != self._topic:
            heard = LiveMessage(self._topic)
        if not self._frozen and heard is not self._shown:
            self._shown = heard
            self._message.show_message(heard)
        self.query_one("#message-state", StaticText).show_whole(self._message_state(heard), MAX_STATE_LINES)

    def _message_state(self, heard: LiveMessage) -> str:
        asked = self._qos.get(self._topic)
        qos = f"requested {asked.text}  " if asked else ""
        if heard.problem:
            return f"{self._topic}  {heard.problem}"
        if not heard.count:
            return (
                f"{self._topic}  {qos}no message yet{silence_reason(asked, self._topic, self._info) if asked else ''}"
            )
        if self._frozen:
            return f"{self._topic}  frozen, +{heard.count - self._shown.count} new; space resumes"
        measure = self._list.measure_of(self._topic)
        rate = rate_text(measure.rate, provisional=measure.provisional) if measure.rate else ""
        parts = [counted(heard.count, "message"), age_text(heard.age), f"{rate} Hz" if rate else ""]
        return f"{self._topic}  {qos}{', '.join(filter(None, parts))}"

    def _report(self) -> None:
        """Update the caption, the placeholder, and the status line on the row at the cursor."""
        shown, row = self._list, self._list.current
        self.report_filter(self._listed, self._every, "including hidden" if self._hidden else "")
        shown.show_placeholder(FILTERED_OUT if self.words else _empty(self._kind))
        text = self._about(row) if row is not None else self._problem
        status = self.query_one("#topics-status", StaticText)
        status.show_text(text)

    def _about(self, row: Row) -> str:
        if row.members:
            fold = "unfolds" if row.is_folded else "folds"
            return row.problem or f"{row.name}  {counted(len(row.members), self._kind.value[:-1])}; enter {fold} them"
        traffic = self.console.topics
        repeated = traffic.repeated().get(row.name) if self._kind is Kind.TOPICS else None
        if repeated:
            return f"publishing here at {repeated.rate:g} Hz, {counted(repeated.count, 'message')}; x ends it"
        goal = traffic.goals().get(row.name) if self._kind is Kind.ACTIONS else None
        if goal is not None:
            return f"{goal.status}, {goal.feedback_count} feedback, {goal.seconds:.1f} s  {goal.problem}"
        if row.problem or self._list.measure_of(row.name).problem:
            return row.problem or self._list.measure_of(row.name).problem
        check = self._list.checks.get(row.name) if self._kind is Kind.TOPICS else None
        if check is not None and check.late:
            return f"{check.measured}, expected {check.expected}"
        ends = f"{' '.join(row.gives) or 'nobody'} → {' '.join(row.takes) or 'nobody'}"
        if self._kind is not Kind.TOPICS:
            return f"{row.type}  {' '.join(row.gives) or 'no server'}"
        expected = f"expected {check.expected}  " if check is not None else ""
        qos = f"  {row.qos}" if row.qos and not self._list.columns(self._list.across).qos else ""
        return f"{expected}{row.type}  {ends}{qos}"

    def on_row_list_moved(self, event: RowList.Moved) -> None:
        """Describe the row at the cursor."""
        event.stop()
        self._report()

    def on_resize(self) -> None:
        """Show the list and the message side by side if there is room."""
        self.set_class(self.size.width >= MIN_SIDE_BY_SIDE_CELLS, "side")

    def on_row_list_resized(self, event: RowList.Resized) -> None:
        """Fit the heading to the columns, and measure the rows in view."""
        event.stop()
        self._update_columns()

    def _update_columns(self) -> None:
        """Update the heading and the measurements for the rows that are visible now."""
        self._head()
        if self.display:
            self._poll(self.clock())

    def action_open(self) -> None:
        """Open the topic's newest message, fold a line or a namespace, or fill in a request or a goal."""
        row = self._list.current
        if self._in_message:
            self._message.fold()
        elif row is not None and row.members:
            self._fold(row.name, closed=not row.is_folded)
        elif row is not None and self._kind is Kind.TOPICS:
            self._open(row.name)
        else:
            self.action_fill()

    def _open(self, topic: str) -> None:
        self._topic, self._frozen, self._shown = topic, False, LiveMessage()
        self._message_polled_at = 0.0
        self._message.show_fields(())
        self._list.opened = topic
        self.add_class("opened")
        self._poll_message(self.clock())
        self.focus_target()
        self.call_after_refresh(self._update_columns)

    def _close(self) -> None:
        self._topic = self._list.opened = ""
        self._message_polled_at = 0.0
        self.console.topics.listen("")
        self.remove_class("opened")
        self.focus_target()
        self.call_after_refresh(self._update_columns)

    def action_clear_filter(self) -> None:
        """Close the message; if none is open, clear the filter."""
        if self._topic:
            self._close()
        else:
            self.set_filter("")

    def action_fold(self, closed: bool) -> None:
        """Fold or unfold the line of the message, or the namespace, at the cursor."""
        row = self._list.current
        if self._in_message:
            self._message.fold(closed)
        elif row is not None and (row.space or row.members):
            self._fold(row.space or row.name, closed=closed)

    def action_fold_all(self) -> None:
        """Fold all namespaces, or unfold them if all are folded."""
        spaces = [each for each in self._list.rows if each.members]
        is_any_open = not all(each.is_folded for each in spaces)
        self._change_folds(frozenset(each.name for each in spaces if is_any_open))

    def _fold(self, space: str, *, closed: bool) -> None:
        rows = self._list.rows
        folded = frozenset(each.name for each in rows if each.is_folded)
        if closed:
            self._list.begin_at(next(at for at, each in enumerate(rows) if each.members and each.name == space))
        self._change_folds(folded | {space} if closed else folded - {space})

    def _change_folds(self, folded: frozenset[str]) -> None:
        if self._query.terms:
            self._folded_matches = folded
        else:
            self._folded = folded
        self._arrange()
        self._poll(self.clock())

    def action_freeze(self) -> None:
        """Freeze or resume the message."""
        if self._topic:
            self._frozen = not self._frozen
            self._poll_message(self.clock())

    def action_qos(self) -> None:
        """Ask for the QoS with which to subscribe to the topic."""
        row = self._current
        topic = self._topic or (row.name if row is not None and self._kind is Kind.TOPICS else "")
        if topic:
            fields = qos_fields(self._qos.get(topic) or RequestedQos())
            then = partial(self._hear, topic)
            self.ask(Form(f"QoS of {topic}", then, arguments=fields, verb="Subscribe", check=qos_problem))

    def _hear(self, topic: str, changed: Mapping[str, str]) -> None:
        qos = changed_qos(self._qos.get(topic) or RequestedQos(), changed)
        self._qos = {**self._qos, topic: qos}
        if qos == RequestedQos():
            del self._qos[topic]
        self._open(topic)

    def action_kind(self) -> None:
        """Switch between topics, services and actions."""
        if self._topic:
            self._close()
        self._kind = _next(self._kind)
        self.border_title = self._kind.value.capitalize()
        self.post_message(self.KeysChanged())
        self._list.set_reactive(RowList.cursor, 0)
        self._arrange()
        self._poll(self.clock())

    def action_hidden(self) -> None:
        """Show or hide hidden and built-in names."""
        self._hidden = not self._hidden
        self._arrange()

    def apply_filter(self, words: str) -> None:
        """Show the rows that pass the filter."""
        self._folded_matches = frozenset()
        super().apply_filter(words)

    def action_plot(self) -> None:
        """Plot the field at the cursor; in the list, one of the topic's fields."""
        row, field = self._current, self._message.current
        if self._in_message:
            if field is None or not field.number:
                self.notify("Only a number can be plotted.", severity="warning")
            else:
                self.post_message(self.PlotWanted(f"{self._topic}/{field.path}"))
        elif row is not None and self._kind is Kind.TOPICS:
            paths = [each for each in self.console.plots.plottable() if each.startswith(f"{row.name}/")]
            if not paths:
                self.notify(f"{row.name} has no numbers to plot.", severity="warning")
            else:
                find = partial(matching_options, [Option(each) for each in paths])
                self.ask(Choice(f"Plot {row.name}", self._plot, find=find, hint="type part of a field"))

    def _plot(self, path: str) -> None:
        self.post_message(self.PlotWanted(path))

    def action_copy(self) -> None:
        """Copy the `ros2` command that shows the same."""
        row = self._current
        if row is not None:
            verb = {Kind.TOPICS: "topic echo", Kind.SERVICES: "service type", Kind.ACTIONS: "action info"}[self._kind]
            text = f"ros2 {verb} {row.name}"
            self.host.copy_to_clipboard(text)
            self.notify(f"copied: {text}", markup=False)

    def action_stop(self) -> None:
        """Stop publishing to the topic, or cancel the goal."""
        row = self._current
        if row is None:
            return
        if self._kind is Kind.ACTIONS:
            answer = self.console.topics.cancel(row.name)
            self.report(answer)
        elif row.name in self.console.topics.repeated():
            self.console.topics.stop(row.name)
            self.notify(f"{row.name}: no longer published from here")
        else:
            self.notify(f"This console is not publishing to {row.name} repeatedly.", severity="warning")

    def action_expect(self) -> None:
        """Ask for a file of expected rates, suggesting the last one; an empty name ends the checks."""
        last = self.state_store.get(EXPECTED_FILE)
        text = last if isinstance(last, str) else ""
        self.ask(Line("file of expected rates", self._expect, text=text, check=_optional_path_problem))

    def _expect(self, path: str) -> None:
        path = str(typed_path(path).absolute()) if path.strip() else ""
        answer = self.console.topics.expect(path)
        if answer.ok and path:
            self.state_store.put(EXPECTED_FILE, path)
        self.report(answer)

    def action_fill(self) -> None:
        """Fill in a message, a request or a goal, and send it."""
        row = self._current
        if row is None or not self.may_change():
            return
        if not row.type:
            self.notify(f"The type of {row.name} is not known.", severity="warning")
            return
        traffic = self.console.topics
        try:
            traffic.slots(self._kind.payload, row.type, {})
        except ValueError as error:
            self.notify(str(error), severity="warning")
            return
        self.ask(
            Fill(row.name, lambda _: None, payload=self._kind.payload, name=row.name, type=row.type, traffic=traffic)
        )


def _optional_path_problem(text: str) -> str:
    return path_problem(text) if text.strip() else ""


def _next(kind: Kind) -> Kind:
    kinds = list(Kind)
    return kinds[(kinds.index(kind) + 1) % len(kinds)]


def _empty(kind: Kind) -> Placeholder:
    """The text that is shown while nothing of a kind exists."""
    actions = (("m", f"List {_next(kind).value}"), ("8", "Start nodes"), ("?", "Help"))
    return Placeholder(f"All {kind.value} of the system are listed here; there are none yet.", actions)
