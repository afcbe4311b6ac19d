"""The base of all panes: a view of one part of the snapshot, with its own help text."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from pathlib import Path
from typing import Any, ClassVar, TypeVar

from bot_console.tui.console.answer import Answer, answer_of
from bot_console.tui.console.model import ConsoleSnapshot
from bot_console.tui.console.protocol import Console
from bot_console.tui.files.save_file import NotSaved, typed_path
from bot_console.tui.files.state_store import MemoryStore, StateStore
from bot_console.tui.keys.key import NO_MODE, Mode
from bot_console.tui.panes.time_cursor import TimeCursor
from bot_console.tui.screens.question_screens import screen_for
from bot_console.tui.text.counted import counted
from bot_console.tui.text.sanitize import sanitize
from bot_console.tui.tuning.specification import TuningSpecification
from bot_console.tui.tuning.tunable import Setting
from bot_console.tui.widgets.lazy_parts import LazyParts
from bot_console.tui.widgets.prompt.common import file_line
from bot_console.tui.widgets.prompt.line import Prompt, find_open_prompt
from bot_console.tui.widgets.prompt.question import Confirmation, Line, Question
from rich.text import Text
from textual.app import App
from textual.geometry import Region
from textual.message import Message
from textual.widget import Widget

P = TypeVar("P", bound="Pane")


class Pane(LazyParts):
    """A pane of the console.

    The app calls `show` with each new snapshot while the pane is visible, and once with the newest one when it becomes
    visible; a hidden pane does nothing. A pane keeps view state only (cursor, filter, scroll): it reads what it shows
    from the snapshot, and acts through `console`.
    """

    TITLE: ClassVar[str] = ""
    HELP: ClassVar[str | None] = ""
    """What the pane is for, in a few lines; the keys are listed from the key table."""
    _only_edge = False
    """Whether the next refresh needs to redraw only the bottom border."""

    SCOPES: ClassVar[tuple[str, ...]] = ("list",)
    """Scopes of the key table that apply in the pane, besides its own."""

    class PlotWanted(Message):
        """Requests a plot of a path."""

        def __init__(self, path: str) -> None:
            super().__init__()
            self.path = path

    class LineWanted(Message):
        """Requests the output of a `ros2` command."""

        def __init__(self, line: str) -> None:
            super().__init__()
            self.line = line

    class EditWanted(Message):
        """Requests a line of a file in an editor."""

        def __init__(self, file: str, line: int) -> None:
            super().__init__()
            self.file = file
            self.line = line

    class PaneWanted(Message):
        """Requests that another pane is shown, and goes to a name in it."""

        def __init__(self, pane: str, name: str) -> None:
            super().__init__()
            self.pane = pane
            self.name = name

    class KeysChanged(Message):
        """The `key_words` or the `mode` have changed."""

    class AlarmsHold(Message):
        """The names of all alarms that are active now."""

        def __init__(self, names: Sequence[str]) -> None:
            super().__init__()
            self.names = names

    class TuningWanted(Message):
        """Requests that settings are tried in simulated runs; `take` is called with the one that the user chooses."""

        def __init__(self, specification: TuningSpecification, take: Callable[[Setting], None]) -> None:
            super().__init__()
            self.specification = specification
            self.take = take

    def __init__(
        self,
        console: Console,
        *,
        id: str | None = None,
        time_cursor: TimeCursor | None = None,
    ) -> None:
        super().__init__(id=id)
        self.console = console
        self.time_cursor = time_cursor or TimeCursor()
        self.border_title = self.TITLE
        self._caption = ""
        self._mode = NO_MODE
        self._key_words: Mapping[str, str] = {}

    @property
    def scopes(self) -> tuple[str, ...]:
        """The scopes of the key table that apply in the pane, its own first."""
        return (self.id or "", *self.SCOPES)

    @property
    def key_words(self) -> Mapping[str, str]:
        """Key descriptions, by action id, that now differ from the key table; empty for keys without an effect."""
        return {}

    @property
    def mode(self) -> Mode:
        """The mode that the pane is in: its keys come first in the key bar, and the help begins with it."""
        return NO_MODE

    def keys_changed(self) -> None:
        """Post `KeysChanged` if `mode` or `key_words` have changed; call it whenever they may have."""
        now = (self.mode, self.key_words)
        if now != (self._mode, self._key_words):
            self._mode, self._key_words = now
            self.post_message(self.KeysChanged())

    @property
    def host(self) -> App[object]:
        """The app, with a type that Textual's own property leaves unknown."""
        return self.app  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType] -- Textual's App is generic

    @property
    def state_store(self) -> StateStore:
        """The storage for the state that panes keep from run to run."""
        return getattr(self.host, "state_store", None) or MemoryStore()

    def caption(self, text: str) -> None:
        """Show a text in the bottom border."""
        if text == self._caption:
            return
        self._caption = text
        self._only_edge = True
        try:
            self.border_subtitle = Text(sanitize(text))
        finally:
            self._only_edge = False

    def refresh(self: P, *regions: Region, repaint: bool = True, layout: bool = False, recompose: bool = False) -> P:
        """Refresh like Textual, but only the bottom border if just the caption has changed."""
        size = self.outer_size
        if self._only_edge and size:
            left, top = self.content_offset
            regions = (Region(-left, size.height - 1 - top, size.width, 1),)
        return super().refresh(*regions, repaint=repaint, layout=layout, recompose=recompose)

    def show(self, snapshot: ConsoleSnapshot) -> None:
        """Draw what is new in the snapshot; parts are compared by identity, and identical ones are not redrawn."""
        raise NotImplementedError

    def observe(self, snapshot: ConsoleSnapshot) -> None:
        """Record what must not be missed in a new snapshot; called before `show`, even while hidden."""

    def tick(self) -> None:
        """Process samples, timeouts and the like, which no snapshot brings; called at 10 Hz, even while hidden."""

    def may_change(self) -> bool:
        """Whether this console may change anything; if not, notifies why, before the user answers questions in vain."""
        why = self.console.snapshot().capabilities.change
        if why:
            self.notify(why, severity="warning", markup=False)
        return not why

    def ask(self, question: Question[Any]) -> None:
        """Ask the user a question: a `Line` at the bottom of the pane, any other on a screen of its own."""
        if isinstance(question, Line):
            self.query_one(Prompt).ask(question)
        else:
            self.host.push_screen(screen_for(question))

    def ask_file(self, label: str, name: str, write: Callable[[Path], Answer], *, replaces: bool = True) -> None:
        """Ask for a file to write, with a confirmation if it would be replaced; then report the result.

        `write` returns the answer to report, or raises `NotSaved`. With `replaces` false, it only changes parts of an
        existing file, so nothing is confirmed.
        """

        def save(path: Path) -> None:
            try:
                self.report(write(path))
            except NotSaved as error:
                self.report(Answer(False, f"not saved: {error}"))

        def named(text: str) -> None:
            path = typed_path(text)
            if replaces and os.path.isfile(path):
                size = counted(path.stat().st_size, "byte")
                reasons = f"The existing file has {size}."
                self.ask(Confirmation(f"Replace {path}?", lambda _: save(path), reasons=reasons))
            else:
                save(path)

        self.ask(file_line(label, name, named))

    def report(self, answer: Answer) -> None:
        """Notify the user of the answer to a request."""
        if answer.text:
            self.notify(answer.text, severity="information" if answer.ok else "error", markup=False)

    def report_later(self, answer: Future[Answer]) -> None:
        """Notify the user of the answer to a request as soon as it arrives."""
        answer.add_done_callback(lambda done: self.host.call_later(self.report, answer_of(done)))

    def check_action(self, action: str, parameters: tuple[object, ...]) -> bool | None:
        """Disable the keys of the pane while a prompt in it is open."""
        return not (self.has_parts and find_open_prompt(self) is not None) and super().check_action(action, parameters)

    def on_mount(self) -> None:
        """Follow the time cursor."""
        self.time_cursor.follow(self)

    def on_unmount(self) -> None:
        """Stop following the time cursor."""
        self.time_cursor.leave(self)

    def time_moved(self, stamp: int | None) -> None:
        """Show the moment (ns since the epoch; None: now) to which the time cursor moved; called even while hidden."""

    def go_to(self, name: str) -> None:
        """Go to a node or a topic, as soon as it exists; called right after the pane was shown."""

    def expect(self, wanted: Sequence[str]) -> None:
        """Show these topics or paths, each as soon as it exists, instead of what the pane shows by default."""

    def steer_on(self, topic: str, rate: float | None) -> None:
        """Steer on a topic at a rate (Hz), if the pane steers."""

    def detach(self) -> None:
        """Stop whatever must not go on without the pane; called when a fault has ended it."""

    def next_part(self, step: int) -> bool:
        """Focus the part of the pane `step` after the focused one; returns whether there is one."""
        return False

    def take_focus(self) -> None:
        """Focus the open prompt, or if there is none, the content of the pane."""
        prompt = find_open_prompt(self) if self.has_parts else None
        if prompt is not None:
            prompt.take_focus()
        else:
            self.focus_target()

    def focus_target(self) -> None:
        """Focus the part of the pane that handles its keys."""
        next((each for each in self.query(Widget) if each.focusable), self).focus()
