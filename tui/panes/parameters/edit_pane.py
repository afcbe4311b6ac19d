"""Editing in the parameter pane: typing and stepping values, sliders, marking edits, comparing two sets, tuning."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial

from bot_console.tui.console.model import Kind, ParameterInfo, SetOutcome, Value
from bot_console.tui.console.parameter_types import ARRAYS
from bot_console.tui.console.parameters.edits import ParameterEdits
from bot_console.tui.console.parameters.safety import takes_safety
from bot_console.tui.console.parameters.staging import SETS, Key
from bot_console.tui.format import field_text
from bot_console.tui.keys.key import Mode
from bot_console.tui.panes.list_pane import ListPane
from bot_console.tui.panes.parameters import editing, tuning_questions
from bot_console.tui.panes.parameters.table import ParameterRows
from bot_console.tui.text.refusals import of_many
from bot_console.tui.text.sanitize import sanitize
from bot_console.tui.text.value_text import value_text
from bot_console.tui.tuning.port import NO_TUNER
from bot_console.tui.tuning.tunable import Setting, Tunable, find_tunables
from bot_console.tui.widgets.prompt.question import Choice, Confirmation, Elements, Line

MARKING = (
    "Values are marked: a sends all of them or none, A sends them as set B, x removes the mark at the cursor, and m "
    "ends marking, so that edits are sent at once again."
)
REFUSED = Mode(
    {"parameters.edit": "Try again", "parameters.dismiss": "Dismiss"},
    "The value at the cursor was refused: Enter edits it again, x dismisses the refusal.",
)


class EditPane(ListPane):
    """The base of the parameter pane: the actions that change values."""

    def __init__(self, *args: object, **kwargs: object) -> None:
        super().__init__(*args, **kwargs)  # type: ignore[arg-type] -- handed on as they are
        self.edits = ParameterEdits(
            self.console.parameters,
            lambda: self.console.snapshot().parameters,
            self.call_later,
            self.redraw_marks,
            self._report_failure,
        )

    @property
    def mode(self) -> Mode:
        """The mode for marked values, for a refused value at the cursor, or for a filter."""
        parameter, staging = self._at(), self.edits.staging
        marked = parameter is not None and (parameter.node, parameter.name) in staging.marked
        if staging.marking or staging.marked:
            keys = {"parameters.apply": f"Apply {len(staging.marked)}", "parameters.compare": "Send as set B"}
            keys = keys if staging.marked else {}
            keys |= {"parameters.dismiss": "Drop"} if marked else {}
            return Mode({**keys, "parameters.stage": "Send at once" if staging.marking else "Mark more"}, MARKING)
        if parameter is not None and (parameter.node, parameter.name) in self.edits.refused:
            return REFUSED
        return super().mode

    @property
    def _list(self) -> ParameterRows:
        return self.query_one(ParameterRows)

    def _at(self) -> ParameterInfo | None:
        row = self._list.current
        return row.parameter if row else None

    def redraw_marks(self) -> None:
        """Redraw marks and refusals, and the details."""
        raise NotImplementedError

    def action_fold(self, closed: bool) -> None:
        """Fold or unfold the row at the cursor."""
        raise NotImplementedError

    def action_edit(self) -> None:
        """Edit a value, toggle a boolean, list the elements of an array, or fold or unfold a node or group."""
        row = self._list.current
        if row is None:
            return
        parameter = row.parameter
        if parameter is None:
            self.action_fold(not row.folded)
        elif parameter.kind not in ARRAYS:
            self.action_edit_text()
        elif self._may_edit(parameter):
            now = self.edits.now(parameter)
            values = now if isinstance(now, tuple) else ()
            then, gone = partial(self.edits.set, parameter), partial(self._gone, parameter)
            parse = partial(editing.typed_element, parameter)
            self.ask(Elements(editing.label(parameter), then, gone, values=values, kind=parameter.kind, parse=parse))

    def action_edit_text(self) -> None:
        """Edit a value on one line; toggle a boolean."""
        parameter = self._at()
        if parameter is None or not self._may_edit(parameter):
            return
        now = self.edits.now(parameter)
        if parameter.kind is Kind.BOOL and isinstance(now, bool):
            self._switch(parameter, now, not now)
            return
        self.ask(
            Line(
                editing.label(parameter),
                partial(self._set_text, parameter),
                partial(self._gone, parameter),
                text=field_text(now),
                check=partial(editing.value_problem, parameter),
                preview=partial(_preview, parameter),
            )
        )

    def _may_edit(self, parameter: ParameterInfo) -> bool:
        """Whether the value can be changed from here; if not, notifies why, before the user types one in vain."""
        if parameter.read_only:
            text = f"{parameter.name} is read-only: a parameter file sets it when {parameter.node} starts."
            self.notify(sanitize(text), severity="warning", markup=False)
        return not parameter.read_only and self.may_change()

    def _switch(self, parameter: ParameterInfo, now: bool, then: bool) -> None:
        """Set a boolean; as a single key does this, ask first if it makes the robot less safe."""
        unsafe = takes_safety(parameter, now, then)
        if not unsafe or self.edits.staging.marking:
            self.edits.set(parameter, then)
            return
        self.ask(
            Confirmation(
                f"Set {parameter.name} to {value_text(then)}?",
                lambda _: self.edits.set(parameter, then),
                gone=partial(self._gone, parameter),
                reasons=f"⚠ {parameter.node} {parameter.name} {value_text(now)} → {value_text(then)} {unsafe}.",
            )
        )

    def _gone(self, parameter: ParameterInfo) -> str:
        """Why a parameter can no longer be set; empty if it can."""
        tree = self.console.snapshot().parameters.get(parameter.node)
        if tree is None:
            return f"{parameter.node} has left; {parameter.name} was not set."
        if tree.get(parameter.name) is None and not tree.problem:
            return f"{parameter.node} no longer has a parameter {parameter.name}; it was not set."
        return ""

    def _set_text(self, parameter: ParameterInfo, text: str) -> None:
        if text != field_text(self.edits.now(parameter)):
            self.edits.set(parameter, editing.typed_value(text, parameter))

    def _report_failure(self, error: str, outcomes: Sequence[SetOutcome]) -> None:
        """Notify why values were not sent, or which of several sent together was refused."""
        text = error or of_many(outcomes)
        if text:
            self.notify(text, severity="error", markup=False)

    def action_dismiss(self) -> None:
        """Dismiss the refusal at the cursor, or unmark its value."""
        if not self.dismiss_refusal():
            self.edits.unstage(self._key_at())

    def dismiss_refusal(self) -> bool:
        """Dismiss the refusal at the cursor; returns whether there was one."""
        return self.edits.dismiss(self._key_at())

    def _key_at(self) -> Key:
        row = self._list.current
        return (row.node, row.parameter.name if row.parameter else "") if row else ("", "")

    def action_nudge(self, steps: int) -> None:
        """Move a number by `steps` steps: its own step, or a hundredth of its range."""
        parameter = self._at()
        value = editing.moved_by_steps(parameter, self.edits.now(parameter), steps) if parameter else None
        if parameter is not None and value is not None:
            self.edits.step(parameter, value)

    def action_limit(self, share: float) -> None:
        """Go to the minimum or maximum of the range."""
        parameter = self._at()
        if parameter is None:
            return
        value = editing.at_share(parameter, share)
        if value is None:
            self.notify(f"{parameter.name} has no range, so no minimum or maximum.")
        else:
            self.edits.set(parameter, value)

    def on_parameter_rows_slid(self, event: ParameterRows.Slid) -> None:
        """Set the value at which the slider was clicked."""
        event.stop()
        value = editing.at_share(event.parameter, event.share)
        if value is not None:
            self.edits.set(event.parameter, value)

    def on_parameter_rows_pressed(self, event: ParameterRows.Pressed) -> None:
        """Edit the clicked row if it was already selected."""
        event.stop()
        self.action_edit()

    def action_reset(self) -> None:
        """Reset the value at the cursor to its default."""
        parameter = self._at()
        if parameter is not None and self.edits.now(parameter) != parameter.default and parameter.default is not None:
            self.edits.set(parameter, parameter.default)

    def action_stage(self) -> None:
        """Switch between marking edits and sending them at once."""
        self.edits.stage()

    def action_apply(self) -> None:
        """Send all marked values together; all of them are accepted, or none."""
        if not self.edits.staging.marked:
            self.notify("Nothing is marked; m marks edits instead of sending them.")
            return
        values = dict(self.edits.staging.marked)
        self._asked_first("Apply what is marked?", values, partial(self.edits.apply, values))

    def action_compare(self) -> None:
        """Make the marked values set B and send it, or swap the two sets."""
        staging = self.edits.staging
        if staging.marked:
            values = dict(self.edits.staging.marked)
            self._asked_first(f"Send {SETS[1]}?", values, partial(self.edits.begin_sets, values))
        elif staging.other:
            values = staging.other
            self._asked_first(f"Send {SETS[1 - staging.live]}?", values, self.edits.swap)
        else:
            self.notify("Mark values with m first: they become set B, and the current values set A.")

    def action_tune(self) -> None:
        """Ask for ranges, score and runs, then tune the marked parameters, or else the one at the cursor."""
        if getattr(self.host, "tuner", None) is None:
            self.notify(NO_TUNER, severity="warning")
            return
        parameter = self._at()
        trees = self.console.snapshot().parameters
        known = [
            tunable
            for tree in trees.values()
            for each in tree.parameters
            if (tunable := tuning_questions.tunable_of(each))
        ]
        keys = self.edits.staging.marked or ({(parameter.node, parameter.name): None} if parameter else {})
        tunables = [each for each in known if (each.node, each.name) in keys]
        if not tunables:
            self.notify("Nothing to tune here: T tunes a number or boolean that can be set, or all that are marked.")
            return
        check = partial(tuning_questions.ranges_problem, known)
        text = tuning_questions.ranges_text(tunables)
        self.ask(Line("tune within", partial(self._ask_score, known), text=text, check=check))

    def _ask_score(self, known: Sequence[Tunable], text: str) -> None:
        tunables = find_tunables(text.split(), [*known])
        find = partial(tuning_questions.scores, self.console.plots.plottable())
        then = partial(self._ask_runs, tunables)
        hint = "a score, or a formula such as mean_speed - 2*collisions"
        self.host.call_later(self.ask, Choice("Score: higher is better", then, find=find, hint=hint))

    def _ask_runs(self, tunables: Sequence[Tunable], score: str) -> None:
        def wrong(text: str) -> str:
            try:
                return tuning_questions.specification_of(
                    tunables, score, text, self.console.snapshot().parameters
                ).problem()
            except ValueError as error:
                return str(error)

        if problem := wrong("60 60"):
            self.notify(problem, severity="error", markup=False)
            return
        then = partial(self._tune, tunables, score)
        self.host.call_later(self.ask, Line("runs, and simulated seconds of each", then, text="60 60", check=wrong))

    def _tune(self, tunables: Sequence[Tunable], score: str, text: str) -> None:
        question = tuning_questions.specification_of(tunables, score, text, self.console.snapshot().parameters)
        wanted = self.TuningWanted(question, partial(self._take_tuned, tunables))
        # After the prompt has returned the focus, so that the key bar is updated before it is covered.
        self.call_after_refresh(self.post_message, wanted)

    def _take_tuned(self, tunables: Sequence[Tunable], setting: Setting) -> None:
        """Send the values found by tuning; a single undo restores the old ones."""
        values: dict[Key, Value] = {
            (tunable.node, tunable.name): value for tunable, value in zip(tunables, setting, strict=True)
        }
        self._asked_first("Apply the tuned values?", values, partial(self.edits.apply, values))

    def _asked_first(self, question: str, values: Mapping[Key, Value], then: Callable[[], None]) -> None:
        """Call `then`; if the values make the robot less safe, ask first."""
        reasons = [
            f"⚠ {each.node} {each.name} {value_text(each.value)} → {value_text(value)} {why}."
            for each, value, why in self.edits.risks(values)
        ]
        if reasons:
            self.ask(Confirmation(question, lambda _: then(), reasons="\n".join(reasons)))
        else:
            then()


def _preview(parameter: ParameterInfo, text: str) -> str:
    """The value of a typed expression, and a warning if it makes the robot less safe."""
    value = editing.typed_value(text, parameter)
    plain = field_text(value)
    unit = f" {parameter.unit}" if parameter.unit else ""
    message = f"= {plain}{unit}" if editing.is_number(value) and not _is_plain(text) else ""
    risk = takes_safety(parameter, parameter.value, value)
    return "  ".join(each for each in (message, f"⚠ {risk}" if risk else "") if each)


def _is_plain(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
