"""Starts the app in steps: first the frames of all panes, then the console, the visible panes, and the hidden ones."""

from __future__ import annotations

from collections import deque
from collections.abc import Awaitable, Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING, NamedTuple, Protocol

from bot_console.tui.arrangement.early_keys import panes_needed
from bot_console.tui.arrangement.stage import Stage
from bot_console.tui.keymap import is_stop_key
from bot_console.tui.pane_table import PANES, PaneEntry
from bot_console.tui.screens.question_screens import prepare
from bot_console.tui.terminal.visible_screen import mount_unseen
from bot_console.tui.widgets.key_bar import KeyBar
from bot_console.tui.widgets.pane_area import PaneArea, PanePlaceholder
from textual import events
from textual.app import App
from textual.widget import MountError, Widget

if TYPE_CHECKING:
    from bot_console.tui.console.command_line import CommandLine
    from bot_console.tui.console.protocol import Console
    from bot_console.tui.keys.keyboard import Keyboard, KeyInput
    from bot_console.tui.panes.pane import Pane

STATUS_PLACEHOLDER = "coming-status"
"""The id of the placeholder for the status bar."""
KEY_POLL_S = 0.005
"""Seconds between two checks whether a key has been handled."""
HIDDEN_PANE_PAUSE_S = 0.02
MAX_HIDDEN_PANE_PAUSE_S = 3.0
"""Seconds by which a pressed key delays the next hidden pane, and their maximum in total."""
ORDERED = sorted(PANES, key=lambda entry: entry.place)
"""The panes in screen order, from the upper left."""


class System(NamedTuple):
    """The console that is shown, and the command line with which it runs lines."""

    console: Console
    command_line: CommandLine | None = None


class StartupHost(Protocol):
    """The operations of the app that its start needs."""

    def attach(self, system: System) -> Sequence[Widget]:
        """Start acting on a system; returns the widgets between the panes and the key bar."""
        ...

    def make_pane(self, entry: PaneEntry) -> Pane:
        """Make a pane of the system."""
        ...

    def start_polling(self) -> None:
        """Start polling for snapshots."""
        ...

    def panes_changed(self) -> None:
        """Lay out again, and show the snapshot in all panes."""
        ...

    def has_recent_key(self) -> bool:
        """Whether a key was pressed just now: its effect should be drawn before anything else."""
        ...


class StartupSequence:
    """Creates one part after the other, and lets the app handle its messages in between.

    Stop keys are handled at once, keys for the visible panes as soon as those exist, all others once every pane exists.
    """

    def __init__(self, app: App[None], host: StartupHost, stage: Stage, keyboard: Keyboard) -> None:
        self._app = app
        self._host = host
        self._stage = stage
        self._keyboard = keyboard
        self._only_hidden_left = False
        """Whether everything visible exists, and only hidden panes are still missing."""
        self._pauses = 0
        self._steps: deque[Callable[[], Awaitable[None]]] = deque()

    def begin(self, reach: Callable[[], System], on_complete: Callable[[], None]) -> None:
        """Create everything; `reach` connects to the system, `on_complete` is called once every pane exists."""
        self._on_complete = on_complete
        self._steps.append(partial(self._connect, reach))
        self._app.call_after_refresh(self.run_next_step)

    async def run_next_step(self) -> None:
        """Create the next part, and continue once the app has handled its messages."""
        if not self._app.is_running:
            return
        if self._keyboard.is_busy:
            self._app.set_timer(KEY_POLL_S, self.run_next_step)
            return
        if self._should_pause():
            self._pauses += 1
            self._app.set_timer(HIDDEN_PANE_PAUSE_S, self.run_next_step)
            return
        try:
            await self._steps.popleft()()
        except MountError:
            if self._app.screen_stack[0].is_attached:
                raise
            return  # a signal has ended the app meanwhile
        if self._steps:
            self._app.call_later(self.run_next_step)
        else:
            self._on_complete()

    def _should_pause(self) -> bool:
        """Whether hidden panes should wait, so that they do not delay the next key."""
        return (
            self._only_hidden_left
            and self._host.has_recent_key()
            and self._keyboard.next is None
            and self._pauses * HIDDEN_PANE_PAUSE_S < MAX_HIDDEN_PANE_PAUSE_S
        )

    async def _connect(self, reach: Callable[[], System]) -> None:
        widgets = self._host.attach(reach())
        screen = self._app.screen_stack[0]
        with self._app.batch_update():
            await screen.query_one(f"#{STATUS_PLACEHOLDER}").remove()
            await screen.mount(*widgets, before=screen.query_one(KeyBar))
        self._host.start_polling()
        await self._keyboard.hold(is_stop)
        places = {each for each, _, _ in self._stage.initial_panes(self._app.size)}
        seen = [each for each in ORDERED if each.id in places]
        self._steps += [partial(self._import_pane, each) for each in seen]
        hidden = deque(each for each in ORDERED if each not in seen)
        self._steps += [
            partial(self._mount_visible, seen),
            *[partial(self._pick_hidden, hidden)] * len(hidden),
            self._complete,
        ]

    async def _import_pane(self, entry: PaneEntry) -> None:
        """Import the modules of a pane; an error is reported later, when the pane is made."""
        try:
            entry.load()
        except Exception:  # importing a pane may raise anything
            return

    async def _mount_visible(self, entries: list[PaneEntry]) -> None:
        area = self._app.screen_stack[0].query_one(PaneArea)
        await area.mount(*map(self._make_pane, entries))
        coming = area.query(PanePlaceholder)
        for each in coming:  # all at once, so that no frame without panes is drawn in between
            each.display = False
        self._host.panes_changed()
        await coming.remove()
        self._only_hidden_left = True
        await self._keyboard.hold(self._may_act)

    async def _pick_hidden(self, hidden: deque[PaneEntry]) -> None:
        """Create the next hidden pane: one that a key is waiting for, if there is one."""
        wanted = self._panes_for_next_key()
        entry = next((each for each in hidden if each.id in wanted), hidden[0])
        hidden.remove(entry)
        self._steps.extendleft((partial(self._mount_hidden, entry), partial(self._import_pane, entry)))

    async def _mount_hidden(self, entry: PaneEntry) -> None:
        area = self._app.screen_stack[0].query_one(PaneArea)
        behind = {each.id for each in ORDERED[ORDERED.index(entry) + 1 :]}
        before = next((each for each in area.children if each.id in behind), None)
        pane = self._make_pane(entry)
        pane.come_late()
        await mount_unseen(area, pane, before)
        self._stage.forget_panes()
        await self._keyboard.hold(self._may_act)

    def _panes_for_next_key(self) -> Sequence[str]:
        key = self._keyboard.next
        return self._panes_for(key) or () if key is not None else ()

    def _may_act(self, key: KeyInput) -> bool:
        wanted = () if is_stop(key) else self._panes_for(key)
        return wanted is not None and {*wanted} <= {each.id for each in self._stage.panes()}

    def _panes_for(self, key: KeyInput) -> Sequence[str] | None:
        return panes_needed(self._app, self._stage, key.key) if isinstance(key, events.Key) else None

    async def _complete(self) -> None:
        self._host.panes_changed()
        prepare()

    def _make_pane(self, entry: PaneEntry) -> Pane:
        pane = self._host.make_pane(entry)
        pane.display = False  # until it is laid out and has the newest snapshot
        return pane


def is_stop(key: KeyInput) -> bool:
    """Whether a key stops the robot."""
    return isinstance(key, events.Key) and is_stop_key(key.key)
