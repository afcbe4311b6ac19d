"""The lesson pane: the step of a course, what to write or to type for it, and what it waits for."""

from __future__ import annotations

import re
from typing import Any, ClassVar

from bot_console.tui import keymap
from bot_console.tui.console.model import ConsoleSnapshot
from bot_console.tui.format import sanitize
from bot_console.tui.learn.lesson_view import Lesson, LessonView, OnScreen
from bot_console.tui.panes.pane import Pane
from bot_console.tui.screens.facts import FactsScreen
from bot_console.tui.widgets.static_text import StaticText
from rich.text import Text
from textual.app import ComposeResult
from textual.containers import VerticalScroll

TICKS_PER_POLL = 5
"""Ticks (of 0.1 s) between two polls of what has happened."""
SHORT_ROWS = 2
"""Rows of the pane up to which it shows two lines."""


class LessonPane(Pane):
    """One step of a course."""

    TITLE = "Lesson"
    HELP = (
        "The step of the course, why it matters, and what to write or to type. Below it stands what it waits for: a\n"
        "step is done as soon as the system or your files show that it is, whichever terminal you did it in. Steps\n"
        "may be done in any order."
    )
    DEFAULT_CSS = """
    LessonPane { border: round $surface-lighten-2; }
    LessonPane:focus-within { border: round $primary; }
    LessonPane VerticalScroll { height: 1fr; scrollbar-size-vertical: 1; }
    LessonPane #lesson-text { height: auto; padding: 0 1; color: $text; text-wrap: wrap; }
    LessonPane #lesson-line { height: 2; display: none; }
    LessonPane.-short VerticalScroll { display: none; }
    LessonPane.-short #lesson-line { display: block; }
    """
    BINDINGS = keymap.bindings("lesson")
    SCOPES: ClassVar[tuple[str, ...]] = ()
    LESSON: ClassVar[Lesson]

    @classmethod
    def of(cls, lesson: Lesson) -> type[LessonPane]:
        """The pane class of a lesson, as the table of panes wants one."""
        return type("LessonPane", (cls,), {"LESSON": lesson, "__doc__": cls.__doc__})

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._lesson = type(self).LESSON
        self._ticks = 0
        self._after = 0
        self._shown: LessonView | None = None
        self._layouts_before: frozenset[str] | None = None
        """The layouts that there were when the lesson was opened; None before it is."""
        self._steered = False
        """Whether keys have driven the robot, however short."""

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
        """Draw the step. What has happened is polled by `tick`, since lessons go on while the pane is hidden."""
        self._draw()

    def observe(self, snapshot: ConsoleSnapshot) -> None:
        """Note what may be over by the next poll."""
        self._steered |= snapshot.drive.armed and snapshot.drive.asked not in (None, (0.0, 0.0))

    def tick(self) -> None:
        """Let the lesson take in what has happened, and say which steps are done."""
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

    def _on_screen(self) -> OnScreen:
        app: Any = self.host
        plot = next(iter(app.screen_stack[0].query("#plot")), None)
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
        if view != self._shown:
            self._shown = view
            self.query_one("#lesson-text", StaticText).update(text_of(view))
            self.query_one(VerticalScroll).scroll_home(animate=False)
            self.query_one("#lesson-line", StaticText).show_text(lines_of(view))
        self.caption(view.problem or f"{view.done} of {view.total} done")

    def action_go(self, by: int) -> None:
        """Show another step, done or not."""
        self._lesson.go(by)
        self._draw()

    def action_copy(self) -> None:
        """Copy what is to be typed or written to the clipboard."""
        view = self._lesson.view()
        if not view.snippets:
            self.notify("This step has nothing to copy.", severity="warning")
            return
        path, text = view.snippets[0]
        self.host.copy_to_clipboard(text)
        self.notify(f"Copied{f': put it into {path}' if path else ''}", markup=False)

    def action_detail(self) -> None:
        """Show the whole step over all panes."""
        view = self._lesson.view()
        parts = [(view.title, view.text.splitlines())]
        parts += [(path or "in a terminal", text.splitlines()) for path, text in view.snippets]
        parts.append(("waits for", [f"{'✓' if held else '○'} {text}" for held, text in view.waits]))
        self.host.push_screen(FactsScreen(sanitize(f"{view.chapter}, step {view.number} of {view.total}"), parts))


def text_of(view: LessonView) -> Text:
    """The whole step."""
    text = Text()
    text.append(f"{sanitize(view.chapter)}\n", "dim")
    text.append(f"{view.number}/{view.total} {sanitize(view.title)}{'  ✓ done' if view.is_done else ''}\n\n", "bold")
    for paragraph in view.text.split("\n\n"):
        if paragraph:
            text.append(f"{sanitize(' '.join(paragraph.split()))}\n\n")
    for held, asked in view.waits:
        text.append("✓ " if held else "○ ", "bold")
        text.append(f"{sanitize(asked)}\n", "dim" if held else "")
    text.append("\n")
    for path, body in view.snippets:
        text.append(f"{sanitize(path) or 'In a terminal'}:\n", "dim")
        for line in re.sub(r"\n{3,}", "\n\n", body).splitlines():
            text.append(f"  {sanitize(line)}\n", "bold")
        text.append("\n")
    return text


def lines_of(view: LessonView) -> Text:
    """The step on two lines: what it is and waits for, and what to type or to write."""
    waiting = next((text for held, text in view.waits if not held), "done; n goes on")
    text = Text()
    text.append(f"{view.number}/{view.total} {sanitize(view.title)}", "bold")
    text.append(f"  {sanitize(waiting)}\n")
    parts = [path or body.partition("\n")[0] for path, body in view.snippets]
    text.append(sanitize(" · ".join(parts)) or "enter shows the whole step", "dim")
    return text
