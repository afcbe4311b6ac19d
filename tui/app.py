"""The app: panes around one snapshot, pulled on a timer."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterable
from concurrent.futures import Future
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

from bot_console.tui import keymap
from bot_console.tui.commands import all_commands, options_for
from bot_console.tui.console.model import ConsoleSnapshot
from bot_console.tui.console.protocol import Console, Launcher
from bot_console.tui.crash import keep, reason
from bot_console.tui.faults import Faults
from bot_console.tui.format import brief, harmless
from bot_console.tui.keyboard import Keyboard
from bot_console.tui.opening import Opening, is_rqt, rqt_opening
from bot_console.tui.pane_table import PANES
from bot_console.tui.panes.broken import BrokenPane
from bot_console.tui.panes.pane import Pane
from bot_console.tui.panes.parameters.pane import ParametersPane
from bot_console.tui.panes.plot.pane import PlotPane
from bot_console.tui.quitting import Quitting
from bot_console.tui.safety_news import SafetyNews
from bot_console.tui.screens.door import screen_for
from bot_console.tui.screens.help import HelpScreen
from bot_console.tui.screens.output import OutputScreen
from bot_console.tui.screens.question import QuestionScreen
from bot_console.tui.terminal.guard import GuardedApp
from bot_console.tui.theme import DARK
from bot_console.tui.widgets.key_bar import KeyBar
from bot_console.tui.widgets.prompt.line import Prompt
from bot_console.tui.widgets.prompt.question import Asker, Choice
from bot_console.tui.widgets.status_bar import StatusBar
from bot_console.tui.widgets.tabs import tabs_text
from textual import events
from textual.app import ComposeResult
from textual.binding import BindingType
from textual.containers import Container
from textual.dom import DOMNode
from textual.geometry import Size
from textual.notifications import SeverityLevel
from textual.types import CSSPathType
from textual.widgets import Input, Static

OVERVIEW = (100, 30)
"""Columns and lines from which several panes are shown at once."""
WIDE = (170, 45)
"""Columns and lines from which the overview has room for the graph as well."""
PLOT = "plot"
SMALLEST = (60, 20)
HERE = Path(__file__).parent
SEEN_AT_ONCE = 2
"""Notifications for which the corner has room."""

AT_ONCE = frozenset(next(key.keys for key in keymap.TABLE["app"] if key.id == "app.quit_now").split(","))
"""Keys that never wait for those typed before."""


class BotConsoleApp(GuardedApp):
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
        *,
        refresh_hz: float = 10.0,
        opening: Opening | None = None,
        on_first_frame: Callable[[], None] | None = None,
    ) -> None:
        super().__init__()
        self.register_theme(DARK)
        self.theme = DARK.name
        self.console_of_robot = console
        self.launcher = launcher
        self._refresh_hz = refresh_hz
        self._opening = opening or Opening()
        self._wanted = self._opening.pane
        self._focused_pane = "parameters"
        self._on_first_frame = on_first_frame
        self._snapshot = ConsoleSnapshot()
        self._panes: list[Pane] = []
        self._extent = Size(80, 24)
        self._quitting = Quitting(self, console)
        self._safety_news = SafetyNews(console)
        self.faults = Faults(self, self._panes_changed)
        self._keyboard = Keyboard(self, super().on_event)

    async def on_event(self, event: events.Event) -> None:
        """Keys are dealt with one after the other; those that quit from anywhere wait for nothing."""
        typed = isinstance(event, (events.Key, events.Paste)) and not event.is_forwarded
        if isinstance(event, (events.Key, events.Paste)) and typed and getattr(event, "key", "") not in AT_ONCE:
            await self._keyboard.typed(event)
        else:
            await super().on_event(event)

    def compose(self) -> ComposeResult:
        """Tabs, panes, status, footer, and a word for terminals that are too small."""
        yield Static("", id="tabs", markup=False)
        with Container(id="panes"):
            for each in sorted(PANES, key=lambda entry: entry.place):
                yield each.load()(self.console_of_robot, self.launcher, id=each.id)
        yield StatusBar()
        yield KeyBar()
        yield Static("", id="too-small", markup=False)

    def on_mount(self) -> None:
        """Choose the theme, lay out, and begin to pull."""
        self.ask()
        self._extent = self.size
        self._lay_out()
        self.pull()
        if self._opening != Opening(self._opening.pane):
            self.open(self._opening)
        if self._refresh_hz > 0:
            self.set_interval(1.0 / self._refresh_hz, self._beat)
        if self._on_first_frame is not None:
            self.call_after_refresh(self._on_first_frame)

    def _beat(self) -> None:
        self.pull()
        with self.batch_update():
            for pane in self.panes():
                pane.tick()

    def pull(self) -> None:
        """Take the newest snapshot and let the visible panes draw what is new."""
        snapshot = self.console_of_robot.snapshot()
        if snapshot is self._snapshot and not self._snapshot.problem:
            return
        self._snapshot = snapshot
        with self.batch_update():
            for pane in self.visible_panes():
                pane.show(snapshot)
            for bar in self.screen_stack[0].query(StatusBar):  # none while the screen is made or taken away
                bar.show(snapshot, self.gate.held_back)
        for asker in self._askers():
            asker.look()
        for text in self._safety_news.since(snapshot):
            self.notify(text, severity="warning")

    def _askers(self) -> Iterable[Asker[Any]]:
        """Whatever has a question open."""
        yield from (each for each in self.screen_stack[0].query(Prompt) if each.is_open)
        if isinstance(self.screen, QuestionScreen):
            yield self.screen

    def panes(self) -> list[Pane]:
        """All panes, in the order in which they stand on the screen."""
        self._panes = self._panes or list(self.query(Pane))
        return self._panes

    def visible_panes(self) -> list[Pane]:
        """The panes that are drawn now."""
        return [each for each in self.panes() if each.display]

    @property
    def current_pane(self) -> Pane | None:
        """The pane that has the keyboard, else the one chosen last."""
        for widget in self.focused.ancestors_with_self if self.focused else ():
            if isinstance(widget, Pane):
                return widget
        return next((each for each in self.panes() if each.id == self._focused_pane), None)

    def on_resize(self, event: events.Resize) -> None:
        """Lay out for the new size."""
        self._extent = event.size
        self._lay_out()

    def _lay_out(self) -> None:
        width, height = self._extent
        small = width < SMALLEST[0] or height < SMALLEST[1]
        self.screen.set_class(small, "small")
        if small:
            self.query_one("#too-small", Static).update(too_small(width, height))
        overview = self._overview_size() if self._wanted == "overview" else 0
        self.screen.set_class(overview > 0, "overview")
        self.screen.set_class(overview > 1, "wide")
        single = self._focused_pane if self._wanted == "overview" else self._wanted
        for each in PANES:
            pane = self.query_one(f"#{each.id}", Pane)
            before = pane.display
            pane.display = 0 < each.overview <= overview if overview else each.id == single
            if pane.display and not before:
                pane.show(self._snapshot)
        self._tabs(overview > 0, single)
        pane = self.current_pane
        if pane is not None and not pane.display:
            pane = next(iter(self.visible_panes()), None)
        if pane is not None and not self._typing():
            pane.focus_target()
        self.show_keys()

    def on_descendant_focus(self) -> None:
        """Another part of the screen has the keyboard: show its keys."""
        self.show_keys()

    def show_keys(self) -> None:
        """Show the keys of the pane that has the keyboard."""
        if self.screen_stack and len(self.screen_stack) == 1:
            pane = self.current_pane
            self.query_one(KeyBar).show(pane.id or "" if pane else "", self._typing(), DARK.primary)

    def _overview_size(self) -> int:
        """Which overview fits: 2 the wide one, 1 the usual one, 0 none, so that panes are shown one at a time."""
        width, height = self._extent
        fits = [width >= need[0] and height >= need[1] for need in (OVERVIEW, WIDE)]
        return sum(fits) if fits[0] else 0

    def _in_overview(self, pane: str) -> bool:
        return any(each.id == pane and 0 < each.overview <= self._overview_size() for each in PANES)

    def _tabs(self, overview: bool, single: str) -> None:
        marks = [("0", "Overview", "All", overview)]
        marks += [
            (each.digit, each.title, each.short or each.title, not overview and each.id == single) for each in PANES
        ]
        self.query_one("#tabs", Static).update(tabs_text(marks, self._extent.width - 2, DARK.primary), layout=False)

    def _typing(self) -> bool:
        return isinstance(self.focused, Input)

    def check_action(self, action: str, parameters: tuple[object, ...]) -> bool | None:
        """Letters and digits belong to a text field while one has the keyboard."""
        if self._typing() and action in ("pane", "all_stop", "zoom", "next_pane"):
            return False
        if len(self.screen_stack) > 1 and action in ("pane", "zoom", "next_pane", "help"):
            # What lies over the panes has keys of its own.
            return False
        return super().check_action(action, parameters)

    def action_pane(self, name: str) -> None:
        """Show a pane, or the overview."""
        self._wanted = name
        if name != "overview":
            self._focused_pane = name
        elif self._overview_size() and not self._in_overview(self._focused_pane):
            self._focused_pane = "parameters"
        self.set_focus(None)
        self._lay_out()

    def action_next_pane(self, step: int) -> None:
        """The next pane: of those seen in the overview, else of all."""
        panes = self.visible_panes() if len(self.visible_panes()) > 1 else self.panes()
        now = self.current_pane
        target = panes[(panes.index(now) + step) % len(panes)] if now in panes else panes[0]
        self._focused_pane = target.id or ""
        if target.display:
            target.focus_target()
        else:
            self.action_pane(self._focused_pane)

    def action_zoom(self) -> None:
        """One pane alone, or the overview again."""
        pane = self.current_pane
        self.action_pane("overview" if self._wanted != "overview" or pane is None else pane.id or "overview")

    def action_all_stop(self) -> None:
        """Hold the robot still, or let it go; a stop that nobody has acknowledged is sent again."""
        drive = self.console_of_robot.snapshot().drive
        if self._quitting.keep_held():
            self.notify("The robot stays held.")
            return
        hold = not drive.stopped or (drive.lockable and not drive.stop_confirmed)
        self.console_of_robot.all_stop(hold)
        self.pull()
        if not hold:
            self.notify("The robot may move again.")

    async def action_quit(self) -> None:
        """End, but ask first where values would be lost."""
        self._quitting.wanted()

    def action_help(self) -> None:
        """Help for the pane that has the keyboard."""
        pane = self.current_pane
        if pane is not None:
            self.push_screen(HelpScreen(pane.id or "", pane.TITLE, pane.HELP or ""))

    def action_palette(self) -> None:
        """Ask for a command: an action by its words, or a `ros2` line."""
        known = all_commands(self, self.current_pane)
        self.push_screen(
            screen_for(
                Choice(
                    "Commands",
                    lambda chosen: known[chosen].run() if chosen in known else self.run_ros2(chosen),
                    find=partial(options_for, known),
                    hint="words of a command, or a ros2 line",
                    empty="No command has these words; a line that begins with ros2 is run.",
                )
            )
        )

    def action_acknowledge(self) -> None:
        """Count only the errors that come from now on."""
        bar = self.screen_stack[0].query_one(StatusBar)
        bar.acknowledge(self._snapshot)
        bar.show(self._snapshot, self.gate.held_back)

    def action_redraw(self) -> None:
        """Draw everything anew."""
        self.redraw()

    def on_pane_plot_wanted(self, event: Pane.PlotWanted) -> None:
        """Plot a path that another pane names."""
        event.stop()
        plot = self.query_one(f"#{PLOT}", Pane)
        if isinstance(plot, PlotPane):
            plot.add(event.path)
        if not plot.display:
            self.action_pane(PLOT)

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
        self._panes = []
        self._snapshot = replace(self._snapshot)
        self._keyboard.release()
        self._lay_out()

    def last_words(self, error: BaseException) -> str:
        """Stop the robot, keep what is known of the fault, and say so on one line."""
        with contextlib.suppress(Exception):  # nothing may come between a fault and the restored terminal
            self.console_of_robot.all_stop(True)
        details = keep(error)
        text = f"bot-console: ended by a fault of its own, the robot was stopped: {reason(error)}"
        return text + (f"; details in {details}" if details else "")

    def run_ros2(self, line: str) -> None:
        """Run a `ros2` line and show what it prints; one that names a program of rqt opens a pane."""
        if is_rqt(line.split()):
            opening, left = rqt_opening(line.split())
            self.open(replace(opening, notes=(*opening.notes, *(f"{each} is not taken over" for each in left))))
            return
        answer = self.console_of_robot.run_line(line)
        answer.add_done_callback(lambda done: self.call_later(self._show_output, line, done))

    def _show_output(self, line: str, done: Future[str]) -> None:
        error = done.exception()
        self.push_screen(OutputScreen(line, str(error) if error else done.result()))


def too_small(width: int, height: int) -> str:
    """What is said in a terminal in which nothing fits but, if need be, four short lines."""
    need = f"{SMALLEST[0]}x{SMALLEST[1]}"
    if width < 40 or height < 6:
        return f"{width}x{height} is too small\n{need} is needed\n! stops the robot\nq quits"
    return f"{width}x{height} is too small\nthe console needs {need}\n\nthe robot goes on; ! stops it, q quits"
