"""What every pane is: a view of one part of the snapshot, with a help text of its own."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any, ClassVar

from bot_console.tui.console.model import ConsoleSnapshot
from bot_console.tui.console.protocol import Console, Launcher
from bot_console.tui.format import counted, harmless
from bot_console.tui.save_file import NotSaved, typed_path
from bot_console.tui.screens.door import screen_for
from bot_console.tui.widgets.prompt.common import file_line
from bot_console.tui.widgets.prompt.line import Prompt
from bot_console.tui.widgets.prompt.question import Confirmation, Line, Question
from rich.text import Text
from textual.app import App
from textual.containers import Container
from textual.message import Message


class Pane(Container):
    """A pane of the console.

    The app calls `show` with each new snapshot while the pane is visible, and once with the newest one when it becomes
    visible; a hidden pane does nothing. A pane keeps view state only (cursor, filter, scroll): what it shows is in the
    snapshot, what it wants done it asks of `console`.
    """

    TITLE: ClassVar[str] = ""
    HELP: ClassVar[str | None] = ""
    """What the pane is for, in a few lines; the keys are listed from the key table."""

    class PlotWanted(Message):
        """Somebody wants to see a path over time."""

        def __init__(self, path: str) -> None:
            super().__init__()
            self.path = path

    def __init__(self, console: Console, launcher: Launcher | None = None, *, id: str | None = None) -> None:
        super().__init__(id=id)
        self.console = console
        self.launcher = launcher
        self.border_title = self.TITLE
        self._caption = ""

    @property
    def host(self) -> App[object]:
        """The app; what Textual's own property leaves unsaid of its type is said here once."""
        return self.app  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType]

    def caption(self, text: str) -> None:
        """Write into the lower edge of the frame; setting the same text again would draw the whole pane."""
        if text != self._caption:
            self._caption = text
            self.border_subtitle = Text(harmless(text))

    def show(self, snapshot: ConsoleSnapshot) -> None:
        """Draw what is new in the snapshot; compare parts by identity and do nothing where they are the same."""
        raise NotImplementedError

    def tick(self) -> None:
        """Ten times a second, also while hidden: what does not come with a snapshot, such as samples and time-outs."""

    def ask(self, question: Question[Any]) -> None:
        """Ask the person something: a line at the foot of the pane, what needs more room over all panes."""
        if isinstance(question, Line):
            self.query_one(Prompt).ask(question)
        else:
            self.host.push_screen(screen_for(question))

    def ask_file(self, label: str, name: str, write: Callable[[Path], str]) -> None:
        """Ask for a file to write, and again where it would replace one.

        `write` gives what to tell then, or raises `NotSaved`.
        """

        def save(path: Path) -> None:
            try:
                self.notify(write(path), markup=False)
            except NotSaved as error:
                self.notify(f"not saved: {error}", severity="error", markup=False)

        def named(text: str) -> None:
            path = typed_path(text)
            if os.path.isfile(path):
                size = counted(path.stat().st_size, "byte")
                self.ask(Confirmation(f"Replace {path}?", lambda _: save(path), reasons=f"There is a file of {size}."))
            else:
                save(path)

        self.ask(file_line(label, name, named))

    def let_go(self) -> None:
        """Stop whatever must not go on without the pane; called when it ends by a fault."""

    def focus_target(self) -> None:
        """Take the keyboard: focus the part of the pane that the keys are for."""
        self.query("*").filter(":can-focus").first().focus()
