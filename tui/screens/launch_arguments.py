"""The arguments of a launch file as a form: defaults filled in, choices as a list."""

from __future__ import annotations

from typing import ClassVar

from bot_console.tui import keymap
from bot_console.tui.console.model import LaunchArgument
from bot_console.tui.screens.question import QuestionScreen
from bot_console.tui.text.sanitize import sanitize
from bot_console.tui.widgets.box import Box
from bot_console.tui.widgets.prompt.question import Form
from rich.text import Text
from textual.app import ComposeResult
from textual.binding import BindingType
from textual.containers import Vertical, VerticalScroll
from textual.suggester import SuggestFromList
from textual.widgets import Input, Static


class ArgumentsScreen(QuestionScreen[dict[str, str]]):
    """Asks for launch arguments or other named values; the answer contains those that differ from their defaults."""

    BINDINGS: ClassVar[list[BindingType]] = [*keymap.bindings("form")]
    DEFAULT_CSS = """
    ArgumentsScreen { align: center middle; }
    ArgumentsScreen Box { width: 90%; max-width: 100; height: auto; max-height: 90%; }
    ArgumentsScreen VerticalScroll { height: auto; max-height: 100%; scrollbar-size-vertical: 1; }
    ArgumentsScreen .argument { height: auto; margin-bottom: 1; }
    ArgumentsScreen .name { text-style: bold; height: 1; }
    ArgumentsScreen .choices { padding: 0 1; height: auto; }
    ArgumentsScreen .about { color: $text-muted; height: auto; }
    ArgumentsScreen Input { border: none; height: 1; padding: 0 1; background: $surface; }
    ArgumentsScreen Input:focus { border: none; background: $block-cursor-background; }
    ArgumentsScreen #wrong { color: $warning; height: auto; }
    """

    def __init__(self, form: Form) -> None:
        super().__init__(form)
        self._form = form
        self._arguments = form.arguments

    def compose(self) -> ComposeResult:
        """Name, value and description of each argument."""
        with Box() as box:
            box.border_title = Text(sanitize(self._form.label))
            box.border_subtitle = f"↑↓ Move · Enter {self._form.verb} · Esc Cancel"
            with VerticalScroll(can_focus=False):
                for each in self._arguments:
                    with Vertical(classes="argument"):
                        yield Static(sanitize(each.name), classes="name", markup=False)
                        suggester = SuggestFromList(each.choices) if each.choices else None
                        yield Input(sanitize(each.default or ""), suggester=suggester, select_on_focus=True)
                        if each.choices:
                            yield Static(choices_line(each, each.default or ""), classes="choices", markup=False)
                        yield Static(self._about(each), classes="about", markup=False)
            yield Static("", id="wrong", markup=False)

    @staticmethod
    def _about(argument: LaunchArgument) -> str:
        parts = [sanitize(argument.description)]
        parts.append("required" if argument.default is None else "")
        parts.append("Page Up and Page Down choose" if argument.choices else "")
        return " · ".join(each for each in parts if each)

    def on_mount(self) -> None:
        """Start at the first required argument."""
        fields = list(self.query(Input))
        needed = (at for at, each in enumerate(self._arguments) if each.default is None)
        self.set_focus(fields[next(needed, 0)])

    def _at(self) -> int:
        fields = list(self.query(Input))
        return fields.index(self.focused) if isinstance(self.focused, Input) else 0

    def action_step(self, step: int) -> None:
        """Go to the next or previous argument."""
        fields = list(self.query(Input))
        self.set_focus(fields[(self._at() + step) % len(fields)])

    def action_choice(self, step: int) -> None:
        """Select the next of the values that the launch file allows."""
        argument, field = self._arguments[self._at()], list(self.query(Input))[self._at()]
        if argument.choices:
            now = argument.choices.index(field.value) if field.value in argument.choices else -step
            field.value = argument.choices[(now + step) % len(argument.choices)]

    def on_input_changed(self, event: Input.Changed) -> None:
        """Mark the value among those that the launch file allows."""
        at = list(self.query(Input)).index(event.input)
        line = next(iter(self.query(".argument")[at].query(".choices").results(Static)), None)
        if line is not None:
            line.update(choices_line(self._arguments[at], event.value))

    def on_input_submitted(self, event: Input.Submitted) -> None:
        """Answer with the values, if they are complete and valid."""
        event.stop()
        values = {each.name: field.value for each, field in zip(self._arguments, self.query(Input), strict=True)}
        wrong = [
            f"{each.name} is required" for each in self._arguments if each.default is None and not values[each.name]
        ]
        wrong += [
            f"{each.name} must be one of {', '.join(each.choices)}"
            for each in self._arguments
            if each.choices and values[each.name] not in each.choices
        ]
        given = {
            each.name: values[each.name]
            for each in self._arguments
            if values[each.name] != sanitize(each.default or "")
        }
        if why := "; ".join(wrong) or self._form.check(given):
            self.query_one("#wrong", Static).update(sanitize(why))
            return
        self.answer(given)


def choices_line(argument: LaunchArgument, value: str) -> str:
    """The values that an argument may have, with its current one marked."""
    return "  ".join(f"{'●' if each == value else '○'} {sanitize(each)}" for each in argument.choices)
