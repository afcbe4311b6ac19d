"""The Textual app: panes that draw one snapshot, polled on a timer."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar, cast

from bot_console.tui import keymap
from bot_console.tui.arrangement.rqt_command_line import Opening
from bot_console.tui.arrangement.stage import Stage
from bot_console.tui.arrangement.startup import ORDERED, STATUS_PLACEHOLDER, StartupSequence, System
from bot_console.tui.console.model import ConsoleSnapshot
from bot_console.tui.files.crash import reason, save_traceback
from bot_console.tui.keys.keyboard import MAX_PASTE_CHARACTERS, Keyboard
from bot_console.tui.layout.built_in import OVERVIEW
from bot_console.tui.pane_table import PANES, PaneEntry
from bot_console.tui.panes.time_cursor import TimeCursor
from bot_console.tui.safety.early_stop import EarlyStop
from bot_console.tui.settings.appearance import Appearance
from bot_console.tui.terminal.exception_guard import GuardedApp
from bot_console.tui.text.counted import counted
from bot_console.tui.text.sanitize import brief, sanitize
from bot_console.tui.theme import THEMES
from bot_console.tui.widgets.key_bar import KeyBar
from bot_console.tui.widgets.pane_area import PaneArea, PanePlaceholder
from bot_console.tui.widgets.tabs import Tabs
from bot_console.tui.widgets.toast_place import place_toasts
from textual import events
from textual.app import ComposeResult
from textual.binding import BindingType
from textual.dom import DOMNode
from textual.notifications import Notify, SeverityLevel
from textual.types import CSSPathType
from textual.widget import Widget
from textual.widgets import Static

if TYPE_CHECKING:
    from bot_console.tui.console.command_line import CommandLine
    from bot_console.tui.console.protocol import Console
    from bot_console.tui.panes.broken_pane import BrokenPane
    from bot_console.tui.panes.pane import Pane
    from bot_console.tui.system_controls import Controls
    from bot_console.tui.tuning.port import Tuner

HERE = Path(__file__).parent
MAX_NOTIFICATIONS = 5
"""Maximum number of notifications kept; the newest is shown, and the earlier ones when it has expired."""
PLOT = "plot"


class BotConsoleApp(GuardedApp):
    """The app of the console: rqt for the terminal."""

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
        command_line: CommandLine | None = None,
        *,
        refresh_hz: float = 10.0,
        opening: Opening | None = None,
        on_first_frame: Callable[[], None] = lambda: None,
        appearance: Appearance | None = None,
        plugins: Callable[[], Sequence[PaneEntry]] = tuple,
        reach: Callable[[], System] | None = None,
    ) -> None:
        """Show a console. With `reach` instead, draw an empty frame first, then connect by calling `reach`.

        Keys typed meanwhile are handled afterwards. `on_first_frame` is called after the panes' first frame.
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
        self._keyboard = Keyboard(self, self._handle_event, self.stage.typing)
        self.key_watch = self.early_stop = EarlyStop(
            lambda: self.input_is_handled and self._keyboard.is_idle, self.stage.typing,
            lambda: self._snapshot.drive.own_stops if self._reached and not self.stage.is_too_small() else frozenset(),
        )  # fmt: skip
        self._reach, self._reached = reach, False
        self.tuner: Tuner | None = None
        """Makes the runs of a tuning; None if tuning is not available."""
        if console is not None:
            self._below = self.attach(System(console, command_line))
        else:
            self._keyboard.may_handle = lambda _: False

    def attach(self, system: System) -> Sequence[Widget]:
        """Start acting on a system; returns the widgets between the panes and the key bar."""
        from bot_console.tui.system_controls import controls_of
        from bot_console.tui.widgets.streams.panels import StreamPanels

        self.console_of_robot = system.console
        self._snapshot = ConsoleSnapshot()
        self.controls: Controls = controls_of(
            *(self, self.stage, system.console, system.command_line),
            early_stop=self.early_stop,
            time_cursor=self.time_cursor,
            redraw=self.redraw,
            open=self.open,
            changed=self.panes_changed,
        )
        self._reached = True
        return StreamPanels(), self.controls.commands.field(), self.controls.status

    async def on_event(self, event: events.Event) -> None:
        """Handle keys one at a time and in order, except those that quit from anywhere, which act at once."""
        if not isinstance(event, (events.Key, events.Paste)) or event.is_forwarded:
            await self._handle_event(event)
        elif isinstance(event, events.Paste) and len(event.text) > MAX_PASTE_CHARACTERS:
            self.notify(
                f"{len(event.text):,} characters were pasted and ignored: the maximum is {MAX_PASTE_CHARACTERS:,}",
                severity="error",
            )
        elif isinstance(event, events.Key) and keymap.is_quit_now_key(event.key):
            self._keyboard.overtake(event)
            await self._handle_event(event)
        else:
            await self._keyboard.typed(event)

    async def _handle_event(self, event: events.Event) -> None:
        if not (isinstance(event, events.Key) and self._is_obsolete(event)):
            await super().on_event(event)

    def _is_obsolete(self, key: events.Key) -> bool:
        """Whether a key is to be ignored: its stop has taken effect already, or a later key has asked to quit.

        Keys typed before that one must not answer the question whether to quit.
        """
        overtaken = self._keyboard.was_overtaken(key)
        if not self._reached:
            return False
        if overtaken and not keymap.is_stop_key(key.key) and self.controls.quitting.asking:
            return True
        return self.early_stop.has_acted(key)

    def compose(self) -> ComposeResult:
        """Compose tabs, panes, status bar, key bar, and a notice for terminals that are too small.

        Before a system is connected, empty frames stand for the panes.
        """
        yield Tabs()
        with PaneArea(id="panes"):
            if self._reached:
                yield from self._all_panes()
            else:
                yield from (
                    PanePlaceholder(id, title, chosen=chosen)
                    for id, title, chosen in self.stage.initial_panes(self.size)
                )
        yield from self._below if self._reached else (Static("", id=STATUS_PLACEHOLDER, markup=False),)
        yield KeyBar()
        yield Static("", id="too-small", markup=False)

    def _all_panes(self) -> Iterator[Pane]:
        """Make all panes; hidden ones compose their content later."""
        seen = self.stage.visible_at(self.size)
        for each in ORDERED:
            pane = self.controls.panes.make(each.load(), each.id)
            if each.id not in seen:
                pane.come_late()
            yield pane

    def on_mount(self) -> None:
        """Choose the theme, lay out, and start polling."""
        self.ask()
        self.stage.resized(self.size)
        self.theme_changed_signal.subscribe(self, lambda _: self.stage.recolour())
        if self._reached:
            self.start_polling()
            self._open_first()
            self.call_after_refresh(self._on_first_frame)
            self.call_after_refresh(self._add_plugins)
        elif self._reach is not None:
            StartupSequence(self, self, self.stage, self._keyboard).begin(self._reach, self._on_complete)

    def start_polling(self) -> None:
        """Start polling for snapshots."""
        self.pull()
        if self._refresh_hz > 0:
            self.set_interval(1.0 / self._refresh_hz, self._heartbeat)

    def _open_first(self) -> None:
        if self._opening != Opening(self._opening.pane):
            self.open(self._opening)

    def make_pane(self, entry: PaneEntry) -> Pane:
        """Make a pane, or a placeholder that says why it cannot be made."""
        return self.controls.faults.make_pane(entry)

    def has_recent_key(self) -> bool:
        """Whether a key was pressed just now: its effect should be drawn before anything else."""
        return self.gate.is_eager

    def _on_complete(self) -> None:
        self._open_first()
        self._on_first_frame()
        self.call_later(self._keyboard.detach)
        self.call_later(self._add_plugins)

    async def _add_plugins(self) -> None:
        """Add panes of other packages, after the first frame so that they do not delay it."""
        found = self._plugins()
        if found:
            self.stage.plugins = [*found]
            await self.controls.faults.add(found)

    def _heartbeat(self) -> None:
        self.pull()
        with self.batch_update():
            for pane in self.panes():
                if not pane.is_ending:
                    pane.tick()
            self.controls.commands.poll()
            self.controls.status.heartbeat()
            if len(self._notifications):
                place_toasts(self.screen)  # keeps the newest remaining one clear of the cursor
            self.stage.drop_unused()

    def pull(self) -> None:
        """Take the newest snapshot and let the visible panes draw what has changed."""
        snapshot = self.controls.stopping.with_key_meaning(self.console_of_robot.snapshot())
        if snapshot is self._snapshot and not self._snapshot.problem:
            return
        self._snapshot = snapshot
        with self.batch_update():
            self.stage.observe(snapshot)
            for pane in self.visible_panes():
                pane.show(snapshot)
            if self.controls.status.is_attached:  # it is not while the screen is being built or removed
                self.controls.status.show(snapshot, self.gate.held_back)
        for requester in self.controls.screens.requesters():
            requester.poll()
        for text in self.controls.safety_announcements.announcements(snapshot):
            self.notify(text, severity="warning")

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
        """Adopt the position of a border that was dragged with the mouse."""
        self.stage.arranging.dragged(event.tree, event.first)

    def on_tabs_chosen(self, event: Tabs.Chosen) -> None:
        """Show the pane whose tab was clicked."""
        self.stage.go(event.pane)

    def check_action(self, action: str, parameters: tuple[object, ...]) -> bool | None:
        """Leave letters and digits to a text field while one has the focus."""
        if self.stage.typing() and action in ("pane", "all_stop", "zoom", "next_pane", "arrange"):
            return False
        if len(self.screen_stack) > 1 and action in ("pane", "zoom", "next_pane", "help", "arrange"):
            # A screen over the panes has its own keys.
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
        self.controls.screens.arrange()

    def action_all_stop(self) -> None:
        """Stop and hold the robot, or release it."""
        self.controls.stopping.pressed()
        self.pull()

    async def action_quit(self) -> None:
        """Quit, but ask first when values would be lost."""
        if self._reached:
            self.controls.quitting.request()
        else:
            self.exit()

    def action_help(self) -> None:
        """Show help for the focused pane."""
        pane = self.current_pane
        if pane is not None:
            self.controls.screens.help(pane)

    def action_palette(self) -> None:
        """Open the command palette."""
        self.controls.commands.palette()

    def action_command_line(self) -> None:
        """Open the command line, for the console's own commands and `ros2` lines."""
        self.controls.commands.ask_line()

    def action_record(self) -> None:
        """Start recording all topics into a bag, or stop the recording."""
        if pane := self.current_pane:
            self.controls.recording.toggle(pane)

    def action_keep_past(self) -> None:
        """Save the last minutes in a bag."""
        if pane := self.current_pane:
            self.controls.recording.keep_past(pane)

    def on_pane_plot_wanted(self, event: Pane.PlotWanted) -> None:
        """Plot a path that another pane names."""
        event.stop()
        plot = cast("Pane", self.query_one(f"#{PLOT}"))
        plot.go_to(event.path)
        if not plot.display:
            self.action_pane(PLOT)

    def on_pane_line_wanted(self, event: Pane.LineWanted) -> None:
        """Run a command line that a pane asks for."""
        event.stop()
        self.controls.commands.runner.run(event.line)

    def on_pane_keys_changed(self, event: Pane.KeysChanged) -> None:
        """Update what the keys of the pane do."""
        event.stop()
        self.stage.show_keys()

    def on_pane_pane_wanted(self, event: Pane.PaneWanted) -> None:
        """Show another pane, at the item named in the message."""
        event.stop()
        self.action_pane(event.pane)
        cast("Pane", self.query_one(f"#{event.pane}")).go_to(event.name)

    def on_pane_edit_wanted(self, event: Pane.EditWanted) -> None:
        """Open a line of a file in the person's editor."""
        event.stop()
        self.controls.leaving.edit(event.file, event.line)

    def on_pane_tuning_wanted(self, event: Pane.TuningWanted) -> None:
        """Start a tuning, and show it over the panes."""
        event.stop()
        self.controls.screens.tune(self.tuner, event)

    def on_pane_alarms_hold(self, event: Pane.AlarmsHold) -> None:
        """Name the active alarms in the status bar."""
        bar = self.controls.status
        bar.alarms = event.names
        bar.show(self._snapshot, self.gate.held_back)

    def action_acknowledge(self) -> None:
        """Reset the error count."""
        bar = self.controls.status
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
            elif (opening.topic or opening.rate) and pane.id == "steering":
                pane.steer_on(opening.topic, opening.rate)
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
        """Show a notification; the text of nodes and people is never parsed as markup."""
        super().notify(brief(message), title=sanitize(title), severity=severity, timeout=timeout, markup=False)

    def on_notify(self, event: Notify) -> None:
        """Make room for a notification above the status line, and add to it how many others there are."""
        others = len(self._notifications)
        if others >= MAX_NOTIFICATIONS:
            self.clear_notifications()
        if others:
            event.notification.message += f"  +{others} more"
        if self.screen_stack:
            place_toasts(self.screen, another=True)

    def contain(self, error: Exception, culprits: list[DOMNode]) -> bool:
        """End only the pane or screen whose code raised; False where none can be blamed."""
        return self._running and self._reached and self.controls.faults.contain(error, culprits)

    async def on_broken_pane_reopen(self, event: BrokenPane.Reopen) -> None:
        """Reopen a pane that ended with an exception."""
        event.stop()
        await self.controls.faults.reopen(event.pane)

    def panes_changed(self) -> None:
        """Lay out again, and show the snapshot in all panes, after a pane was replaced or added."""
        self._snapshot = replace(self._snapshot)
        self._keyboard.release()
        self.stage.changed()

    def last_words(self, error: BaseException) -> str:
        """Stop the robot, save the traceback, and return a one-line summary."""
        with contextlib.suppress(Exception):  # after a fault, nothing may keep the terminal from being restored
            self.console_of_robot.drive.stop(True, "bot-console has failed")
        details = save_traceback(error)
        text = f"bot-console: ended by an internal error, the robot was stopped: {reason(error)}"
        return text + (f"; details in {details}" if details else "")

    def action_sleep(self) -> None:
        """Suspend the console; the robot is held meanwhile."""
        self.controls.leaving.sleep()

    def on_text_selected(self) -> None:
        """Copy the text selected with the mouse."""
        text = self.screen.get_selected_text()
        if text:
            self.copy_to_clipboard(text)
            self.notify(f"Copied {counted(len(text), 'character')}.")

    def action_end_stream(self) -> None:
        """Stop the command line that is running below the panes."""
        self.controls.commands.end_stream()
