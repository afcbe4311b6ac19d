"""The lesson pane: the step of a course, what to write or type for it, and the conditions it waits for."""

from __future__ import annotations

import re
import textwrap
from typing import Any, ClassVar

from bot_console.tui import keymap
from bot_console.tui.console.model import ConsoleSnapshot
from bot_console.tui.learn.lesson_view import Lesson, LessonView, OnScreen
from bot_console.tui.panes.pane import Pane
from bot_console.tui.screens.facts import FactsScreen
from bot_console.tui.text.sanitize import sanitize
from bot_console.tui.widgets.static_text import StaticText
from rich.text import Text
from textual.app import ComposeResult
from textual.containers import VerticalScroll

TICKS_PER_POLL = 5
"""Ticks (of 0.1 s) between two checks of the lesson's conditions."""
SHORT_ROWS = 2
"""Maximum rows of a pane that shows only two lines of the step."""
LISTING_SHARE = 3
"""A listing that others follow takes at most a third of the rows, so that the next one is visible, too."""
FRAME_COLUMNS = 5
"""Columns of the pane beside its text: borders, padding and scroll bar."""


class LessonPane(Pane):
    """One step of a course."""

    TITLE = "Lesson"
    HELP = (
        "The step of the course, why it matters, what to write or type, and what it waits for: a step is done as\n"
        "soon as the system or your files show that it is, whichever terminal you did it in. Steps may be done in\n"
        "any order."
    )
    DEFAULT_CSS = """
    LessonPane { border: round $surface-lighten-2; }
    LessonPane:focus-within { border: round $primary; }
    LessonPane VerticalScroll { height: 1fr; scrollbar-size-vertical: 1; }
    LessonPane #lesson-text { height: auto; padding: 0 1; color: $text; text-wrap: wrap; text-overflow: fold; }
    LessonPane #lesson-line { height: 2; display: none; }
    LessonPane.-short VerticalScroll { display: none; }
    LessonPane.-short #lesson-line { display: block; }
    """
    BINDINGS = keymap.bindings("lesson")
    SCOPES: ClassVar[tuple[str, ...]] = ()
    LESSON: ClassVar[Lesson]

    @classmethod
    def of(cls, lesson: Lesson) -> type[LessonPane]:
        """Create a pane class for a lesson: the table of panes needs a class."""
        return type("LessonPane", (cls,), {"LESSON": lesson, "__doc__": cls.__doc__})

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._lesson = type(self).LESSON
        self._ticks = 0
        self._after = 0
        self._shown: tuple[LessonView, int, int] | None = None
        """The step that is drawn, and the columns and rows it is drawn for."""
        self._copied = -1, -1
        """The number of the step, and the index of the listing of it that was copied last."""
        self._layouts_before: frozenset[str] | None = None
        """The layouts that existed when the lesson was opened; None before that."""
        self._steered = False
        """Whether the robot has been driven with keys, however briefly."""

    def compose(self) -> ComposeResult:
        """The whole step, or two lines of it."""
        with VerticalScroll(can_focus=True):
            yield StaticText(id="lesson-text")
        yield StaticText(id="lesson-line")

    def on_resize(self) -> None:
        """Show two lines where there is no room for more."""
        self.set_class(self.size.height <= SHORT_ROWS, "-short")
        self._draw()

    def show(self, snapshot: ConsoleSnapshot) -> None:
        """Draw the step. `tick` checks the lesson's conditions, since a lesson goes on while its pane is hidden."""
        self._draw()

    def tick(self) -> None:
        """Let the lesson check its conditions, and notify of the steps that are done."""
        self._steered = self._steered or self._steers()
        self._ticks += 1
        if self._ticks % TICKS_PER_POLL:
            return
        snapshot = self.console.snapshot()
        changes = self.console.parameters.changes(self._after)
        self._after = max((each.seq + 1 for each in changes), default=self._after)
        for title in self._lesson.observe(snapshot, changes, self._on_screen()):
            self.notify(f"Done: {title}", markup=False)
        if self.display:
            self._draw()

    def _pane(self, id: str) -> Any:
        return next(iter(self.host.screen_stack[0].query(f"#{id}")), None)

    def _steers(self) -> bool:
        """Whether keys drive the robot now."""
        steering = getattr(self._pane("steering"), "state", None)
        return steering is not None and steering.armed and steering.moving

    def _on_screen(self) -> OnScreen:
        app: Any = self.host
        plot = self._pane("plot")
        curves = getattr(getattr(plot, "_timeline", None), "curves", ())
        layouts = frozenset(app.stage.arrangement.layouts())
        if self._layouts_before is None:
            self._layouts_before = layouts
        return OnScreen(
            frozenset(app.stage.opened),
            frozenset(str(each.path) for each in curves),
            layouts - self._layouts_before,
            self._steered,
        )

    def _draw(self) -> None:
        view = self._lesson.view()
        if not self.has_parts:
            return
        wanted = view, self.size.width - FRAME_COLUMNS, self.size.height
        if wanted != self._shown:
            self._shown = wanted
            self.query_one("#lesson-text", StaticText).update(step_text(*wanted))
            self.query_one(VerticalScroll).scroll_home(animate=False)
            self.query_one("#lesson-line", StaticText).show_text(step_lines(*wanted[:2]))
        way = "" if self.has_focus_within else " · Tab: its keys"
        self.caption(view.problem or f"{view.done} of {view.total} done{way}")

    def action_go(self, by: int) -> None:
        """Show another step, done or not."""
        self._lesson.go(by)
        self._draw()

    def action_copy(self) -> None:
        """Copy the listing to type or write to the clipboard; if there are several, the next one each time."""
        view = self._lesson.view()
        if not view.snippets:
            self.notify("This step has nothing to copy.", severity="warning")
            return
        number, last = self._copied
        now = (last + 1) % len(view.snippets) if number == view.number else 0
        self._copied = view.number, now
        path, text = view.snippets[now]
        self.host.copy_to_clipboard(text)
        which = f" {now + 1} of {len(view.snippets)}" if len(view.snippets) > 1 else ""
        self.notify(f"Copied{which}: {f'put it into {path}' if path else text.partition(chr(10))[0]}", markup=False)

    def action_detail(self) -> None:
        """Show the whole step over all panes."""
        view = self._lesson.view()
        parts = [(view.title, _paragraphs(view))]
        parts += [(path or "in a terminal", text.splitlines()) for path, text in view.snippets]
        parts.append(("waits for", [f"{'✓' if held else '○'} {text}" for held, text in view.waits]))
        self.host.push_screen(FactsScreen(sanitize(f"{view.chapter}, step {view.number} of {view.total}"), parts))


def step_text(view: LessonView, columns: int = 0, rows: int = 0) -> Text:
    """The whole step; with `columns`, long lines are wrapped, and with `rows`, long listings are shortened."""
    text = Text()
    text.append(f"{sanitize(view.chapter)}\n", "dim")
    text.append(f"{view.number}/{view.total} {sanitize(view.title)}{'  ✓ done' if view.is_done else ''}\n\n", "bold")
    for paragraph in _paragraphs(view):
        text.append(f"{sanitize(paragraph)}\n\n")
    for held, asked in view.waits:
        text.append("✓ " if held else "○ ", "bold")
        text.append(f"{sanitize(asked)}\n", "dim" if held else "")
    text.append("\n")
    for number, (path, body) in enumerate(view.snippets, 1):
        text.append(f"{sanitize(path) or 'In a terminal'}:\n", "dim")
        lines = re.sub(r"\n{3,}", "\n\n", body).splitlines()
        most = max(rows // LISTING_SHARE, 1) if rows and number < len(view.snippets) else len(lines)
        for line in lines[:most]:
            for piece in wrapped(sanitize(line), columns - 2):
                text.append(f"  {piece}\n", "bold")
        if len(lines) > most:
            text.append(f"  … {len(lines) - most} more lines: enter shows them, y copies all\n", "dim")
        text.append("\n")
    return text


def _paragraphs(view: LessonView) -> list[str]:
    return [" ".join(each.split()) for each in view.text.split("\n\n") if each]


def wrapped(line: str, columns: int) -> list[str]:
    """Wrap a line of a listing; each piece but the last ends with `…`, and each but the first is indented further."""
    own = line[: len(line) - len(line.lstrip())]
    if columns < len(own) + 12 or len(line) <= columns:
        return [line]
    words = textwrap.TextWrapper(columns - 2, own, f"{own}    ", break_long_words=False, break_on_hyphens=False)
    found = words.wrap(line.lstrip())
    return [*(f"{each} …" for each in found[:-1]), found[-1]]


def step_lines(view: LessonView, columns: int = 0) -> Text:
    """The step on two lines: its title and the condition it waits for, then what to type or write.

    The condition matters most: if it does not fit into the columns, the title is left out, and if it then needs two
    lines, what to type is left out, too.
    """
    waiting = sanitize(next((text for held, text in view.waits if not held), "done; n shows the next step"))
    head, title = f"{view.number}/{view.total}", f" {sanitize(view.title)}"
    if 0 < columns < len(f"{head}{title}  {waiting}"):
        title = ""
        if len(lines := textwrap.wrap(f"{head}  {waiting}", columns)) > 1:
            # The rest may be longer than the second line, which then ends with an ellipsis.
            return Text.assemble((head, "bold"), f"{lines[0]}\n{' '.join(lines[1:])}".removeprefix(head))
    text = Text.assemble((f"{head}{title}", "bold"), f"  {waiting}\n")
    parts = [path or body.strip().replace("\n", " · ") for path, body in view.snippets]
    text.append(sanitize(" · ".join(parts)) or "enter shows the whole step", "dim")
    return text
