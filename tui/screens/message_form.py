"""A form for a message, request or goal, and the replies: rqt's publisher and service caller."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Future
from functools import partial
from typing import ClassVar

from bot_console.tui import keymap
from bot_console.tui.console.topics.port import Field, Goal, Payload, Reply, Slot
from bot_console.tui.format import parse_number
from bot_console.tui.screens.question import QuestionScreen
from bot_console.tui.text.sanitize import cut, sanitize
from bot_console.tui.widgets.box import Box
from bot_console.tui.widgets.prompt.line import Prompt
from bot_console.tui.widgets.prompt.question import Fill, Line
from bot_console.tui.widgets.row_list import RowList
from bot_console.tui.widgets.static_text import StaticText
from rich.cells import cell_len
from rich.segment import Segment
from rich.text import Text
from textual.app import ComposeResult
from textual.binding import BindingType

WORDS = {
    Payload.MESSAGE: ("Publish to", "s Send once · r Send at a rate"),
    Payload.REQUEST: ("Call", "s Call"),
    Payload.GOAL: ("Goal for", "s Send · x Cancel"),
}
USUAL_RATE = "10"
"""The rate (Hz) that is suggested."""


class SlotRows(RowList):
    """One field per line: name, value, unit and type; a dot marks typed values."""

    def __init__(self) -> None:
        super().__init__()
        self.slots: Sequence[Slot] = ()
        self.typed: dict[str, str] = {}

    @property
    def current(self) -> Slot | None:
        """The slot at the cursor."""
        return self.slots[self.cursor] if self.cursor < len(self.slots) else None

    def row_count(self) -> int:
        """The number of slots."""
        return len(self.slots)

    def row(self, index: int, width: int) -> list[Segment]:
        """Name, value with its unit, and type or choices."""
        slot = self.slots[index]
        longest = max(2 * each.depth + cell_len(each.name) for each in self.slots) + 4
        names = min(longest, max(8, width // 2))
        dim = self.row_style("dim")
        strong = self.row_style("strong")
        typed = slot.path in self.typed
        name = cut(f"{'● ' if typed else '  '}{'  ' * slot.depth}{sanitize(slot.name)}", names, pad=True)
        value = cut(f"{sanitize(slot.text)}{' ' + slot.unit if slot.unit and slot.text else ''}", max(0, width - names))
        room = width - names - cell_len(value) - 2
        kind = " | ".join(slot.choices) if slot.choices and index == self.cursor else slot.type
        return [
            Segment(name, None if slot.editable else dim),
            Segment(value, strong if typed else None),
            Segment(cut(f"  {sanitize(kind)}", max(0, room + 2)), dim),
        ]


class ReplyRows(RowList):
    """The reply, line by line."""

    can_focus = False

    def __init__(self) -> None:
        super().__init__()
        self.fields: Sequence[Field] = ()

    def row_count(self) -> int:
        """The number of lines."""
        return len(self.fields)

    def row(self, index: int, width: int) -> list[Segment]:
        """Name and value."""
        field = self.fields[index]
        dim = self.row_style("dim")
        name = f" {'  ' * field.depth}{sanitize(field.name)}: "
        return [Segment(name, dim), Segment(sanitize(f"{field.text} {field.unit if field.text else ''}"))]


class FillScreen(QuestionScreen[None]):
    """A form to fill in and send; it stays open, so that it can be sent again with other values."""

    BINDINGS: ClassVar[list[BindingType]] = [*keymap.bindings("fill")]
    DEFAULT_CSS = """
    FillScreen { align: center middle; }
    FillScreen Box { width: 94%; max-width: 120; height: 90%; }
    FillScreen ReplyRows { height: 0; max-height: 50%; }
    FillScreen #fill-state.good { color: $success; }
    FillScreen #fill-state.wrong { color: $warning; }
    """

    def __init__(self, question: Fill) -> None:
        super().__init__(question)
        self._asked = question
        self._values: dict[str, str] = {}
        self._back = 0
        """How many sent forms back the shown one is; 0 for the unsent draft."""
        self._draft: dict[str, str] = {}
        self._goal: Goal | None = None
        self._sent = 0

    def compose(self) -> ComposeResult:
        """The form, the reply, the state, and a field for one value."""
        what, keys = WORDS[self._asked.payload]
        with Box() as box:
            box.border_title = Text(sanitize(f"{what} {self._asked.name}  {self._asked.type}"))
            box.border_subtitle = f"Enter Edit · {keys} · [ ] Earlier · y Copy · Esc Close"
            yield SlotRows()
            yield StaticText(id="fill-state")
            yield ReplyRows()
            yield Prompt(id="fill-prompt")

    @property
    def _rows(self) -> SlotRows:
        return self.query_one(SlotRows)

    def on_mount(self) -> None:
        """Start at the first editable field."""
        rows = self._rows
        self._fill_in()
        self.set_focus(rows)
        first = (at for at, each in enumerate(rows.slots) if each.editable and "header" not in each.path)
        rows.cursor = next(first, 0)
        if not rows.slots:
            self._show_text("There is nothing to fill in.")

    def _fill_in(self) -> None:
        rows = self._rows
        rows.typed = dict(self._values)
        rows.slots = self._asked.traffic.slots(self._asked.payload, self._asked.type, self._values)
        rows.rows_changed()

    def _show_text(self, text: str, *, ok: bool | None = None) -> None:
        state = self.query_one("#fill-state", StaticText)
        state.show_text(text)
        state.set_class(ok is True, "good")
        state.set_class(ok is False, "wrong")

    def action_edit(self) -> None:
        """Edit the value of the field at the cursor; on a heading, go to the first field below it."""
        rows, slot = self._rows, self._rows.current
        if slot is None:
            return
        if not slot.editable:
            rows.action_cursor(1)
            return
        words = [each.partition(" ")[2] for each in slot.choices]
        label = f"{slot.name} (yaw, 90° or 1.57)" if slot.type == "geometry_msgs/Quaternion" else slot.name
        text = "" if label != slot.name and slot.path not in self._values else slot.text
        check = partial(self._asked.traffic.wrong, self._asked.payload, self._asked.type, slot.path)
        self.query_one(Prompt).ask(
            Line(label, partial(self._typed, slot.path), text=text, check=check, suggestions=words)
        )

    def _typed(self, path: str, text: str) -> None:
        inside = [each for each in self._values if each.startswith(f"{path}.")]
        for each in inside:
            del self._values[each]  # a yaw replaces all four numbers of a quaternion
        self._values[path] = text
        self._back = 0
        self._fill_in()

    def action_default(self) -> None:
        """Reset the field to its default."""
        slot = self._rows.current
        if slot is not None and self._values.pop(slot.path, None) is not None:
            self._fill_in()

    def action_earlier(self, step: int) -> None:
        """Show an earlier or later sent form; after the newest one comes the unsent draft."""
        known = self._asked.traffic.earlier(self._asked.name)
        back = max(0, min(self._back + step, len(known)))
        if back == self._back:
            self._show_text("Nothing earlier was sent from here." if step > 0 else "There is nothing newer.", ok=False)
            return
        if self._back == 0:
            self._draft = dict(self._values)
        self._back = back
        self._values = dict(known[-back]) if back else dict(self._draft)
        self._fill_in()
        self._show_text(f"{back} of {len(known)} sent earlier" if back else "the unsent draft")

    def action_send(self) -> None:
        """Publish the message once, call the service, or send the goal."""
        asked, traffic = self._asked, self._asked.traffic
        if asked.payload is Payload.REQUEST:
            self._show_text(f"{asked.name} was called ...")
            self._show([])
            answer = traffic.call(asked.name, asked.type, dict(self._values))
            answer.add_done_callback(partial(self.call_later, self._answered))
            return
        if asked.payload is Payload.GOAL:
            self._goal = None
            sent = traffic.send_goal(asked.name, asked.type, dict(self._values))
        else:
            sent = traffic.publish(asked.name, asked.type, dict(self._values))
            self._sent += sent.ok
        again = f" ({self._sent} times)" if asked.payload is Payload.MESSAGE and self._sent > 1 and sent.ok else ""
        self._show_text(sent.text + again, ok=sent.ok)

    def _answered(self, done: Future[Reply]) -> None:
        if not self.is_running:
            return
        error = done.exception()
        reply = Reply(False, str(error)) if error else done.result()
        took = f"answered after {reply.seconds * 1e3:.1f} ms"
        self._show_text(took if reply.ok else reply.text, ok=reply.ok)
        self._show(reply.fields)

    def _show(self, fields: Sequence[Field]) -> None:
        rows = self.query_one(ReplyRows)
        rows.fields = fields
        rows.styles.height = min(len(fields), max(3, self.size.height // 3))
        rows.rows_changed()

    def poll(self) -> bool:
        """Show the state of a goal; called with each snapshot."""
        goal = self._asked.traffic.goals().get(self._asked.name) if self._asked.payload is Payload.GOAL else None
        if goal is not None and self.is_running and goal != self._goal:
            self._goal = goal
            count = f", {goal.feedback_count} feedback" if goal.feedback_count else ""
            ok = None if goal.active else goal.status == "succeeded"
            self._show_text(f"{goal.status} after {goal.seconds:.1f} s{count}  {goal.problem}", ok=ok)
            self._show(goal.result if not goal.active and goal.result else goal.feedback)
        return super().poll()

    def action_repeat(self) -> None:
        """Ask for a rate (Hz), and publish the message repeatedly."""
        if self._asked.payload is Payload.MESSAGE:
            line = Line("rate (Hz)", self._repeat, text=USUAL_RATE, check=_rate_problem)
            self.query_one(Prompt).ask(line)

    def _repeat(self, typed: str) -> None:
        asked = self._asked
        sent = asked.traffic.publish(asked.name, asked.type, dict(self._values), parse_number(typed))
        self._show_text(f"{sent.text}; x ends it" if sent.ok else sent.text, ok=sent.ok)

    def action_stop(self) -> None:
        """Stop publishing at a rate, or cancel the goal."""
        asked, traffic = self._asked, self._asked.traffic
        if asked.payload is Payload.GOAL:
            answer = traffic.cancel(asked.name)
            self._show_text(answer.text, ok=answer.ok)
        elif asked.name in traffic.repeated():
            traffic.stop(asked.name)
            self._show_text("no longer published from here")

    def action_copy(self) -> None:
        """Copy the `ros2` command that sends the same."""
        asked = self._asked
        running = asked.traffic.repeated().get(asked.name)
        text = asked.traffic.line(asked.payload, asked.name, asked.type, self._values, running.rate if running else 0.0)
        self.host.copy_to_clipboard(text)
        self._show_text(f"copied: {text}")


def _rate_problem(text: str) -> str:
    try:
        rate = parse_number(text)
    except ValueError as error:
        return str(error)
    return "" if 0 < rate <= 1000 else "the rate must be above 0 and at most 1000 Hz"
