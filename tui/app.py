"""The Textual app: panes that draw one snapshot, polled on a timer."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

from bot_console.tui import keymap
from bot_console.tui.appearance import Appearance
from bot_console.tui.arrangement.arrival import COMING_STATUS, ArrivingApp, System
from bot_console.tui.arrangement.stage import Stage
from bot_console.tui.files.crash import keep, reason
from bot_console.tui.keys.keyboard import MAX_PASTE_CHARACTERS, Keyboard
from bot_console.tui.layout.named import OVERVIEW
from bot_console.tui.notifying import NotifyingApp
from bot_console.tui.opening import Opening
from bot_console.tui.pane_requests import PaneRequests
from bot_console.tui.pane_table import PANES, PaneEntry
from bot_console.tui.recording import RecordingApp
from bot_console.tui.safety.early_stop import EarlyStop
from bot_console.tui.screens.tuning.requests import TuningRequests
from bot_console.tui.text.sanitize import counted
from bot_console.tui.theme import THEMES
from bot_console.tui.time_cursor import TimeCursor
from bot_console.tui.widgets.key_bar import KeyBar
from bot_console.tui.widgets.pane_area import PaneArea, PanePlaceholder
from bot_console.tui.widgets.tabs import Tabs
from textual import events
from textual.app import ComposeResult
from textual.binding import BindingType
from textual.dom import DOMNode
from textual.types import CSSPathType
from textual.widgets import Static

if TYPE_CHECKING:
    from bot_console.tui.console.command_line import CommandLine
    from bot_console.tui.console.launch.port import Launcher
    from bot_console.tui.console.protocol import Console
    from bot_console.tui.panes.broken_pane import BrokenPane
    from bot_console.tui.panes.pane import Pane

HERE = Path(__file__).parent

P = TypeVar("P", bound="Pane")


class BotConsoleApp(NotifyingApp, RecordingApp, TuningRequests, PaneRequests, ArrivingApp):
    """rqt for the terminal."""

    TITLE = "bot-console"
    CSS_PATH: ClassVar[CSSPathType | None] = [
        HERE / "app.tcss",
        *(HERE / "panes" / each.id / "pane.tcss" for each in PANES),
    ]
    BINDINGS: ClassVar[list[BindingType]] = [*keymap.bindings("app")]
    ENABLE_COMMAND_PALETTE = False

    def __init__(
        self,
        console: Console | None = None,
        launcher: Launcher | None = None,
        command_line: CommandLine | None = None,
        *,
        refresh_hz: float = 10.0,
        opening: Opening | None = None,
        on_first_frame: Callable[[], None] = lambda: None,
        appearance: Appearance | None = None,
        plugins: Callable[[], Sequence[PaneEntry]] = tuple,
        reach: Callable[[], System] | None = None,
    ) -> None:
        """Show a console; with `reach` instead of one, a frame first, then what that gives, with keys typed meanwhile.

        `on_first_frame` is called once the first frame of the panes has been seen.
        """
        super().__init__()
        for each in THEMES.values():
            self.register_theme(each)
        appearance = appearance or Appearance()
        self.theme = THEMES[appearance.theme].name
        self.use_colours()
        self.plain, self.state_store, self.graph_hides = (
            appearance.plain,
            appearance.state_store,
            appearance.graph_hides,
        )
        self.set_keymap({**appearance.keys})
        self._refresh_hz = refresh_hz
        self._opening = opening or Opening()
        self.time_cursor = TimeCursor()
        self._on_first_frame = on_first_frame
        self.stage = Stage(self, appearance.arrangement, self._opening.pane, lambda: self._snapshot)
        self._plugins = plugins
        self._keyboard = Keyboard(self, self._deal, self.stage.typing)
        self.key_watch = self.early_stop = EarlyStop(
            lambda: self.input_is_handled and self._keyboard.is_idle, self.stage.typing,
            lambda: self._reached and self._snapshot.drive.stopped_here,
        )  # fmt: skip
        self._reach, self._reached = reach, False
        if console is not None:
            self.attach(System(console, launcher, command_line))
        else:
            self._keyboard.passes = lambda _: False

    def attach(self, system: System) -> None:
        """Start acting on a system."""
        from bot_console.tui.app_parts import AppParts
        from bot_console.tui.console.model import ConsoleSnapshot

        self.console_of_robot, self.launcher = system.console, system.launcher
        self._snapshot = ConsoleSnapshot()
        self.parts = AppParts(
            *(self, self, self.stage, system.console, system.command_line),
            early_stop=self.early_stop,
            redraw=self.redraw,
            open=self.open,
            changed=self.panes_changed,
        )
        self.command_handler, self.faults = self.parts.command_handler, self.parts.faults
        self._reached = True

    async def on_event(self, event: events.Event) -> None:
        """Handle keys one at a time, in order; those that quit from anywhere wait for nothing."""
        if not isinstance(event, (events.Key, events.Paste)) or event.is_forwarded:
            await self._deal(event)
        elif isinstance(event, events.Paste) and len(event.text) > MAX_PASTE_CHARACTERS:
            self.notify(
                f"{len(event.text):,} characters were pasted and ignored: {MAX_PASTE_CHARACTERS:,} at most",
                severity="error",
            )
        elif isinstance(event, events.Key) and keymap.quits_at_once(event.key):
            self._keyboard.overtake(event)
            await self._deal(event)
        else:
            await self._keyboard.typed(event)

    async def _deal(self, event: events.Event) -> None:
        overtaken = isinstance(event, events.Key) and self._keyboard.was_overtaken(event)
        if not (self._reached and self.parts.is_spent(event, overtaken=overtaken)):
            await super().on_event(event)

    def compose(self) -> ComposeResult:
        """Tabs, panes, status bar, key bar, and a notice for terminals that are too small; empty frames at first."""
        yield Tabs()
        with PaneArea(id="panes"):
            if self._reached:
                yield from self.made_at_once()
            else:
                yield from (
                    PanePlaceholder(id, title, chosen=chosen) for id, title, chosen in self.stage.at_first(self.size)
                )
        yield from self.parts.widgets() if self._reached else (Static("", id=COMING_STATUS, markup=False),)
        yield KeyBar()
        yield Static("", id="too-small", markup=False)

    def on_mount(self) -> None:
        """Choose the theme, lay out, and start polling."""
        self.ask()
        self.stage.resized(self.size)
        self.theme_changed_signal.subscribe(self, lambda _: self.stage.recolour())
        if self._reached:
            self.begin_to_pull()
            self._open_first()
            self.call_after_refresh(self._on_first_frame)
            self.call_after_refresh(self._add_plugins)
        elif self._reach is not None:
            self.arrive(self._reach, self._all_there)

    def begin_to_pull(self) -> None:
        """Start polling for snapshots."""
        self.pull()
        if self._refresh_hz > 0:
            self.set_interval(1.0 / self._refresh_hz, self._heartbeat)

    def _open_first(self) -> None:
        if self._opening != Opening(self._opening.pane):
            self.open(self._opening)

    def is_stop(self, key: object) -> bool:
        """Whether a key stops the robot."""
        return isinstance(key, events.Key) and keymap.stops(key.key)

    def _all_there(self) -> None:
        self._open_first()
        self._on_first_frame()
        self.call_later(self._keyboard.detach)
        self.call_later(self._add_plugins)

    async def _add_plugins(self) -> None:
        """Add panes of other packages, after the first frame so that they do not delay it."""
        found = self._plugins()
        if found:
            self.stage.plugins = [*found]
            await self.faults.add(found)

    def _heartbeat(self) -> None:
        self.pull()
        with self.batch_update():
            for pane in self.panes():
                if not pane.is_ending:
                    pane.tick()
            self.parts.heartbeat()
            self.update_notifications()
            self.stage.drop_unused()

    def pull(self) -> None:
        """Take the newest snapshot and let the visible panes draw what has changed."""
        snapshot = self.console_of_robot.snapshot()
        if snapshot is self._snapshot and not self._snapshot.problem:
            return
        self._snapshot = snapshot
        with self.batch_update():
            self.stage.observe(snapshot)
            for pane in self.visible_panes():
                pane.show(snapshot)
            if self.parts.status.is_attached:  # not while the screen is made or taken away
                self.parts.status.show(snapshot, self.gate.held_back)
        for requester in self.parts.requesters():
            requester.poll()
        for text in self.parts.safety_news.since(snapshot):
            self.notify(text, severity="warning")

    def entries(self) -> Sequence[PaneEntry]:
        """All available panes."""
        return self.stage.entries()

    def made(self, kind: type[P], id: str, **facts: Any) -> P:
        """Make a pane of a class for the system being shown."""
        return kind(self.console_of_robot, self.launcher, id=id, time_cursor=self.time_cursor, **facts)

    def panes(self) -> list[Pane]:
        """All panes, in screen order."""
        return self.stage.panes()

    def visible_panes(self) -> list[Pane]:
        """The panes being drawn."""
        return self.stage.visible()

    @property
    def current_pane(self) -> Pane | None:
        """The focused pane, else the one chosen last."""
        return self.stage.current()

    def on_resize(self, event: events.Resize) -> None:
        """Lay out for the new size."""
        self.stage.resized(event.size)

    def on_descendant_focus(self) -> None:
        """Show the keys of whatever has the focus now."""
        self.stage.show_keys()

    def on_pane_area_dragged(self, event: PaneArea.Dragged) -> None:
        """Take over a border that was moved with the mouse."""
        self.stage.arranging.dragged(event.tree, event.first)

    def on_tabs_chosen(self, event: Tabs.Chosen) -> None:
        """Show the pane whose tab was clicked."""
        self.stage.go(event.pane)

    def check_action(self, action: str, parameters: tuple[object, ...]) -> bool | None:
        """Leave letters and digits to a text field while one has the focus."""
        if self.stage.typing() and action in ("pane", "all_stop", "zoom", "next_pane", "arrange"):
            return False
        if len(self.screen_stack) > 1 and action in ("pane", "zoom", "next_pane", "help", "arrange"):
            # What lies over the panes has keys of its own.
            return False
        return super().check_action(action, parameters)

    def action_pane(self, name: str) -> None:
        """Show one pane, or the layout."""
        self.stage.go(name)

    def action_next_pane(self, step: int) -> None:
        """Go to the next pane: among those on the screen, else among all."""
        self.stage.next(step)

    def action_zoom(self) -> None:
        """Show one pane alone, or the layout again."""
        self.stage.zoom()

    def action_arrange(self) -> None:
        """Arrange the panes with keys."""
        self.stage.go(OVERVIEW)
        self.parts.arrange()

    def action_all_stop(self) -> None:
        """Stop and hold the robot, or release it."""
        self.parts.act_on_stop(self.parts.stopping.wanted)
        self.pull()

    async def action_quit(self) -> None:
        """Quit, but ask first when values would be lost."""
        if self._reached:
            self.parts.quitting.wanted()
        else:
            self.exit()

    def action_help(self) -> None:
        """Show help for the focused pane."""
        pane = self.current_pane
        if pane is not None:
            self.parts.help(pane)

    def action_palette(self) -> None:
        """Open the command palette."""
        self.command_handler.palette()

    def action_command_line(self) -> None:
        """Open the command line, for the console's own commands and `ros2` lines."""
        self.command_handler.ask_line()

    def on_pane_alarms_hold(self, event: Pane.AlarmsHold) -> None:
        """Name the active alarms in the status bar."""
        bar = self.parts.status
        bar.alarms = event.names
        bar.show(self._snapshot, self.gate.held_back)

    def action_acknowledge(self) -> None:
        """Reset the error count."""
        bar = self.parts.status
        bar.acknowledge(self._snapshot)
        bar.show(self._snapshot, self.gate.held_back)

    def action_theme(self) -> None:
        """Switch to the next theme."""
        names = [each.name for each in THEMES.values()]
        self.theme = names[(names.index(self.theme) + 1) % len(names)]
        self.notify(f"Theme: {self.theme.removeprefix('bot-')}; to keep it: `bot-console config --edit`")

    def action_glyphs(self) -> None:
        """Switch between ASCII, and lines and braille."""
        self.plain = not self.plain
        self.redraw()

    def action_redraw(self) -> None:
        """Redraw everything."""
        self.redraw()

    def open(self, opening: Opening) -> None:
        """Show a pane with the requested curves and node, which may appear later."""
        self.action_pane(opening.pane)
        for pane in self.panes():
            if opening.curves and pane.id == "plot":
                pane.expect(opening.curves)
            elif opening.node and pane.id == "parameters":
                pane.go_to(opening.node)
        for pane in self.visible_panes():
            pane.show(self._snapshot)
        for note in opening.notes:
            self.notify(note, severity="warning", markup=False)

    def contain(self, error: Exception, culprits: list[DOMNode]) -> bool:
        """End only the pane or screen whose code raised; False where none can be blamed."""
        return self._running and self._reached and self.faults.contain(error, culprits)

    async def on_broken_pane_reopen(self, event: BrokenPane.Reopen) -> None:
        """Reopen a pane that ended with an exception."""
        event.stop()
        await self.faults.reopen(event.pane)

    def panes_changed(self) -> None:
        """Lay out again, and show the snapshot in all panes, after a pane was replaced or added."""
        self._snapshot = replace(self._snapshot)
        self._keyboard.release()
        self.stage.changed()

    def last_words(self, error: BaseException) -> str:
        """Stop the robot, save the traceback, and return a one-line summary."""
        with contextlib.suppress(Exception):  # nothing may come between a fault and the restored terminal
            self.console_of_robot.drive.stop(True, "bot-console has failed")
        details = keep(error)
        text = f"bot-console: ended by a fault of its own, the robot was stopped: {reason(error)}"
        return text + (f"; details in {details}" if details else "")

    def action_sleep(self) -> None:
        """Suspend the console; the robot is held meanwhile."""
        self.parts.leaving.sleep()

    def on_text_selected(self) -> None:
        """Copy the text selected with the mouse."""
        text = self.screen.get_selected_text()
        if text:
            self.copy_to_clipboard(text)
            self.notify(f"Copied: {counted(len(text), 'letter')}.")

    def action_end_stream(self) -> None:
        """Stop the command line that is running below the panes."""
        self.command_handler.end_stream()
