"""The app: panes around one snapshot, pulled on a timer."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, ClassVar, TypeVar

from bot_console.tui import keymap
from bot_console.tui.arrangement.stage import Stage
from bot_console.tui.commanding.desk import Desk
from bot_console.tui.console.connection.no_console import NoCommandLine
from bot_console.tui.console.connection.read_only import ReadOnlyConsole
from bot_console.tui.console.model import ConsoleSnapshot
from bot_console.tui.console.protocol import CommandLine, Console, Launcher
from bot_console.tui.faults import Faults
from bot_console.tui.files.crash import keep, reason
from bot_console.tui.format import brief, counted, harmless
from bot_console.tui.keys.keyboard import Keyboard
from bot_console.tui.layout.named import OVERVIEW
from bot_console.tui.look import Look
from bot_console.tui.opening import Opening
from bot_console.tui.pane_table import PANES, PaneEntry
from bot_console.tui.pane_wishes import PaneWishes
from bot_console.tui.panes.broken import BrokenPane
from bot_console.tui.panes.pane import Pane
from bot_console.tui.panes.parameters.pane import ParametersPane
from bot_console.tui.panes.plot.pane import PlotPane
from bot_console.tui.recording import RecordingApp
from bot_console.tui.safety.quitting import Quitting
from bot_console.tui.safety.safety_news import SafetyNews
from bot_console.tui.safety.stopping import Stopping
from bot_console.tui.screens.arrange import ArrangeScreen
from bot_console.tui.screens.help import HelpScreen
from bot_console.tui.screens.question import QuestionScreen
from bot_console.tui.screens.tuning.door import TuningDoor
from bot_console.tui.terminal.leaving import Leaving
from bot_console.tui.theme import THEMES
from bot_console.tui.time_cursor import TimeCursor
from bot_console.tui.widgets.key_bar import KeyBar
from bot_console.tui.widgets.pane_area import PaneArea
from bot_console.tui.widgets.prompt.line import Prompt
from bot_console.tui.widgets.prompt.question import Asker
from bot_console.tui.widgets.status_bar import StatusBar
from bot_console.tui.widgets.stream_panel import StreamPanel
from bot_console.tui.widgets.tabs import Tabs
from textual import events
from textual.app import ComposeResult
from textual.binding import BindingType
from textual.dom import DOMNode
from textual.notifications import SeverityLevel
from textual.types import CSSPathType
from textual.widgets import Static

HERE = Path(__file__).parent
SEEN_AT_ONCE = 2
"""Notifications for which the corner has room."""

P = TypeVar("P", bound=Pane)

AT_ONCE = frozenset(next(key.keys for key in keymap.TABLE["app"] if key.id == "app.quit_now").split(","))
"""Keys that never wait for those typed before."""
STOPS = frozenset(next(key.keys for key in keymap.TABLE["app"] if key.id == "app.stop").split(","))


class BotConsoleApp(RecordingApp, TuningDoor, PaneWishes):
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
        console: Console,
        launcher: Launcher | None = None,
        command_line: CommandLine | None = None,
        *,
        refresh_hz: float = 10.0,
        opening: Opening | None = None,
        on_first_frame: Callable[[], None] | None = None,
        look: Look | None = None,
        plugins: Callable[[], Sequence[PaneEntry]] = tuple,
    ) -> None:
        super().__init__()
        for each in THEMES.values():
            self.register_theme(each)
        look = look or Look()
        self.theme = THEMES[look.theme].name
        self.use_colours()
        self.plain, self.kept = look.plain, look.kept
        self.set_keymap({**look.keys})
        self.console_of_robot = console
        self.launcher = launcher
        self._refresh_hz = refresh_hz
        self._opening = opening or Opening()
        self.time_cursor = TimeCursor()
        self._on_first_frame = on_first_frame
        self._snapshot = ConsoleSnapshot()
        self.stage = Stage(self, look.arrangement, self._opening.pane, lambda: self._snapshot)
        self._quitting = Quitting(self, console)
        self._stopping = Stopping(self, console)
        self._leaving = Leaving(self, console, self.redraw, holds=not isinstance(console, ReadOnlyConsole))
        lines = command_line or NoCommandLine()
        self.desk = Desk(self, self.stage, self._stopping, console, lines, self.open, self._leaving.run)
        self._safety_news = SafetyNews(console)
        self._plugins = plugins
        self.faults = Faults(self, self, self._panes_changed)
        self._keyboard = Keyboard(self, self._deal)

    async def on_event(self, event: events.Event) -> None:
        """Keys are dealt with one after the other; those that quit from anywhere wait for nothing."""
        if not isinstance(event, (events.Key, events.Paste)) or event.is_forwarded:
            await self._deal(event)
        elif isinstance(event, events.Key) and event.key in AT_ONCE:
            self._keyboard.overtake(event)
            await self._deal(event)
        else:
            await self._keyboard.typed(event)

    async def _deal(self, event: events.Event) -> None:
        # The question whether to quit is not answered by what was typed before the key that asked it.
        early = isinstance(event, events.Key) and event.key not in STOPS and self._keyboard.was_overtaken(event)
        if not (early and self._quitting.asking):
            await super().on_event(event)

    def compose(self) -> ComposeResult:
        """Tabs, panes, status, footer, and a word for terminals that are too small."""
        yield Tabs()
        with PaneArea(id="panes"):
            for each in sorted(PANES, key=lambda entry: entry.place):
                yield self.made(each.load(), each.id)
        yield StreamPanel()
        yield self.desk.field()
        yield StatusBar()
        yield KeyBar()
        yield Static("", id="too-small", markup=False)

    def on_mount(self) -> None:
        """Choose the theme, lay out, and begin to pull."""
        self.ask()
        self.stage.resized(self.size)
        self.pull()
        if self._opening != Opening(self._opening.pane):
            self.open(self._opening)
        if self._refresh_hz > 0:
            self.set_interval(1.0 / self._refresh_hz, self._beat)
        if self._on_first_frame is not None:
            self.call_after_refresh(self._on_first_frame)
        self.call_after_refresh(self._add_plugins)

    async def _add_plugins(self) -> None:
        """Panes of others, looked for when the first frame has been seen, which they are not to delay."""
        found = self._plugins()
        if found:
            self.stage.plugins = [*found]
            await self.faults.add(found)

    def _beat(self) -> None:
        self.pull()
        with self.batch_update():
            for pane in self.panes():
                if pane.children:  # none at the end, when the screen is taken apart
                    pane.tick()
            self.desk.look()

    def pull(self) -> None:
        """Take the newest snapshot and let the visible panes draw what is new."""
        snapshot = self.console_of_robot.snapshot()
        if snapshot is self._snapshot and not self._snapshot.problem:
            return
        self._snapshot = snapshot
        with self.batch_update():
            for pane in self.visible_panes():
                pane.show(snapshot)
            for bar in self.screen_stack[0].children:  # none while the screen is made or taken away
                if isinstance(bar, StatusBar):
                    bar.show(snapshot, self.gate.held_back)
        for asker in self._askers():
            asker.look()
        for text in self._safety_news.since(snapshot):
            self.notify(text, severity="warning")

    def _askers(self) -> Iterable[Asker[Any]]:
        """Whatever has a question open."""
        yield from (each for each in self.screen_stack[0].walk_children(Prompt) if each.is_open)
        if isinstance(self.screen, QuestionScreen):
            yield self.screen

    def entries(self) -> Sequence[PaneEntry]:
        """All panes that there are."""
        return self.stage.entries()

    def made(self, kind: type[P], id: str, **facts: Any) -> P:
        """A pane of a class, for the system that is shown."""
        return kind(self.console_of_robot, self.launcher, id=id, time_cursor=self.time_cursor, **facts)

    def panes(self) -> list[Pane]:
        """All panes, in the order in which they stand on the screen."""
        return self.stage.panes()

    def visible_panes(self) -> list[Pane]:
        """The panes that are drawn now."""
        return self.stage.visible()

    @property
    def current_pane(self) -> Pane | None:
        """The pane that has the keyboard, else the one chosen last."""
        return self.stage.current()

    def on_resize(self, event: events.Resize) -> None:
        """Lay out for the new size."""
        self.stage.resized(event.size)

    def on_descendant_focus(self) -> None:
        """Another part of the screen has the keyboard: show its keys."""
        self.stage.show_keys()

    def on_pane_area_dragged(self, event: PaneArea.Dragged) -> None:
        """A border between panes was moved with the mouse."""
        self.stage.arranging.dragged(event.tree, event.first)

    def on_tabs_chosen(self, event: Tabs.Chosen) -> None:
        """A tab was clicked."""
        self.stage.go(event.pane)

    def check_action(self, action: str, parameters: tuple[object, ...]) -> bool | None:
        """Letters and digits belong to a text field while one has the keyboard."""
        if self.stage.typing() and action in ("pane", "all_stop", "zoom", "next_pane", "arrange"):
            return False
        if len(self.screen_stack) > 1 and action in ("pane", "zoom", "next_pane", "help", "arrange"):
            # What lies over the panes has keys of its own.
            return False
        return super().check_action(action, parameters)

    def action_pane(self, name: str) -> None:
        """Show a pane, or the layout."""
        self.stage.go(name)

    def action_next_pane(self, step: int) -> None:
        """The next pane: of those seen together, else of all."""
        self.stage.next(step)

    def action_zoom(self) -> None:
        """One pane alone, or the layout again."""
        self.stage.zoom()

    def action_arrange(self) -> None:
        """Arrange the panes by key."""
        self.stage.go(OVERVIEW)
        if self.stage.arranging.begin():
            self.push_screen(ArrangeScreen(self.stage.arranging))

    def action_all_stop(self) -> None:
        """Hold the robot still, or let it go."""
        if self._quitting.keep_held():
            self.notify("The robot stays held.")
        else:
            self._stopping.wanted()
            self.pull()

    async def action_quit(self) -> None:
        """End, but ask first where values would be lost."""
        self._quitting.wanted()

    def action_help(self) -> None:
        """Help for the pane that has the keyboard."""
        pane = self.current_pane
        if pane is not None:
            self.push_screen(HelpScreen(pane.scopes, pane.TITLE, pane.HELP or ""))

    def action_palette(self) -> None:
        """Ask for a command: an action by its words."""
        self.desk.palette()

    def action_command_line(self) -> None:
        """Ask for a line: a verb of the console, or one of `ros2`."""
        self.desk.ask_line()

    def on_pane_alarms_hold(self, event: Pane.AlarmsHold) -> None:
        """Name the alarms that hold in the status bar."""
        bar = self.screen_stack[0].query_one(StatusBar)
        bar.alarms = event.names
        bar.show(self._snapshot, self.gate.held_back)

    def action_acknowledge(self) -> None:
        """Count only the errors that come from now on."""
        bar = self.screen_stack[0].query_one(StatusBar)
        bar.acknowledge(self._snapshot)
        bar.show(self._snapshot, self.gate.held_back)

    def action_theme(self) -> None:
        """Show the next theme."""
        names = [each.name for each in THEMES.values()]
        self.theme = names[(names.index(self.theme) + 1) % len(names)]
        self.notify(f"Theme: {self.theme.removeprefix('bot-')}; `bot-console config --edit` makes it last.")

    def action_glyphs(self) -> None:
        """Draw with plain letters, or with lines and braille again."""
        self.plain = not self.plain
        self.redraw()

    def action_redraw(self) -> None:
        """Draw everything anew."""
        self.redraw()

    def open(self, opening: Opening) -> None:
        """Show a pane with the curves and the node that are asked for; both may come later."""
        self.action_pane(opening.pane)
        for plot in self.query(PlotPane) if opening.curves else ():
            plot.expect(opening.curves)
        for parameters in self.query(ParametersPane) if opening.node else ():
            parameters.expect(opening.node)
        for pane in self.visible_panes():
            pane.show(self._snapshot)
        for note in opening.notes:
            self.notify(note, severity="warning", markup=False)

    def notify(
        self,
        message: str,
        *,
        title: str = "",
        severity: SeverityLevel = "information",
        timeout: float | None = None,
        markup: bool = False,
    ) -> None:
        """Tell something in a corner; what nodes and people write is shown as it is written, whoever tells it."""
        if len(self._notifications) >= SEEN_AT_ONCE:
            self.clear_notifications()  # the newest, a refusal above all, must have room
        super().notify(brief(message), title=harmless(title), severity=severity, timeout=timeout, markup=False)

    def contain(self, error: Exception, culprits: list[DOMNode]) -> bool:
        """A fault ends the pane, or what lies over the panes, in whose code it happened."""
        return self._running and self.faults.contain(error, culprits)

    async def on_broken_pane_reopen(self, event: BrokenPane.Reopen) -> None:
        """Open a pane again that has ended by a fault."""
        event.stop()
        await self.faults.reopen(event.pane)

    def _panes_changed(self) -> None:
        """A pane stands where another was: lay out, and show all of them what there is."""
        self._snapshot = replace(self._snapshot)
        self._keyboard.release()
        self.stage.changed()

    def last_words(self, error: BaseException) -> str:
        """Stop the robot, keep what is known of the fault, and say so on one line."""
        with contextlib.suppress(Exception):  # nothing may come between a fault and the restored terminal
            self.console_of_robot.all_stop(True)
        details = keep(error)
        text = f"bot-console: ended by a fault of its own, the robot was stopped: {reason(error)}"
        return text + (f"; details in {details}" if details else "")

    def action_sleep(self) -> None:
        """Give the terminal back to the shell; the robot is held meanwhile."""
        self._leaving.sleep()

    def on_text_selected(self) -> None:
        """Text was selected with the mouse: it is on the clipboard."""
        text = self.screen.get_selected_text()
        if text:
            self.copy_to_clipboard(text)
            self.notify(f"Copied: {counted(len(text), 'letter')}.")

    def action_end_stream(self) -> None:
        """End the line that goes on below the panes."""
        self.desk.end_stream()
