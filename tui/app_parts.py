"""The parts of the app that need a console: the command line, stopping, fault handling, quitting, suspending.

The app imports this module only after its first frame: these parts import the whole model, which would delay the frame
by a third.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from bot_console.tui.arrangement.stage import Stage
from bot_console.tui.commanding.command_handler import CommandHandler
from bot_console.tui.console.command_line import CommandLine
from bot_console.tui.console.gated_lines import GatedLines
from bot_console.tui.console.protocol import Console
from bot_console.tui.faults import Faults, PaneMaker
from bot_console.tui.keymap import stops
from bot_console.tui.opening import Opening
from bot_console.tui.panes.pane import Pane
from bot_console.tui.safety.early_stop import EarlyStop
from bot_console.tui.safety.quitting import Quitting
from bot_console.tui.safety.safety_news import SafetyNews
from bot_console.tui.safety.stopping import Stopping
from bot_console.tui.screens.arrange import ArrangeScreen
from bot_console.tui.screens.help import HelpScreen
from bot_console.tui.screens.question import QuestionScreen
from bot_console.tui.terminal.suspension import Leaving
from bot_console.tui.widgets.prompt.line import Prompt
from bot_console.tui.widgets.prompt.question import Requester
from bot_console.tui.widgets.status_bar import StatusBar
from bot_console.tui.widgets.streams.panels import StreamPanels
from textual import events
from textual.app import App
from textual.widget import Widget


class AppParts:
    """Those parts, made for one app and one console."""

    def __init__(
        self,
        app: App[None],
        maker: PaneMaker,
        stage: Stage,
        console: Console,
        lines: CommandLine | None,
        *,
        early_stop: EarlyStop,
        redraw: Callable[[], None],
        open: Callable[[Opening], None],
        changed: Callable[[], None],
    ) -> None:
        """`redraw` sends every cell again, `open` shows what was asked for, `changed` follows a replaced pane."""
        self._app = app
        self._stage = stage
        self.quitting = Quitting(app, console)
        self.stopping = Stopping(app, console)
        self._early_stop = early_stop
        early_stop.attach(console.drive, lambda: self.act_on_stop(self.stopping.hold))
        self.leaving = Leaving(app, console, redraw, holds=not console.gate.read_only)
        self.command_handler = CommandHandler(
            app, stage, self.stopping, console, lines or GatedLines(console.gate, None), open, self.leaving.run
        )
        self.safety_news = SafetyNews(console.parameters)
        self.faults = Faults(app, maker, changed)
        self.status = StatusBar()

    def widgets(self) -> Sequence[Widget]:
        """The widgets between the panes and the key bar, top to bottom."""
        return StreamPanels(), self.command_handler.field(), self.status

    def is_spent(self, event: events.Event, *, overtaken: bool) -> bool:
        """Whether an event means nothing any more, a key that was overtaken or not.

        The question whether to quit is not answered by what was typed before the key that asked it.
        """
        if not isinstance(event, events.Key):
            return False
        return (overtaken and not stops(event.key) and self.quitting.asking) or self._early_stop.has_acted(event)

    def act_on_stop(self, act: Callable[[], None]) -> None:
        """Do what a stop key does; while the question whether to quit holds the robot, it stays held instead."""
        if self.quitting.keep_held():
            self._app.notify("The robot stays held.")
        else:
            act()

    def heartbeat(self) -> None:
        """Ten times a second: take in what running command lines print, and show figures that were held back."""
        self.command_handler.poll()
        self.status.heartbeat()

    def arrange(self) -> None:
        """Arrange the panes with keys, if there is room for that."""
        if self._stage.arranging.begin():
            self._app.push_screen(ArrangeScreen(self._stage.arranging))

    def help(self, pane: Pane) -> None:
        """Show what a pane is for, and its keys."""
        text = "\n\n".join(each for each in (pane.mode.help, pane.HELP) if each)
        self._app.push_screen(HelpScreen(pane.scopes, pane.TITLE, text))

    def requesters(self) -> Sequence[Requester[Any]]:
        """Everything that has an open question."""
        # An open prompt has the keyboard; nobody has it while the terminal has lost it. To look through all that is on
        # the screen at each snapshot takes a tenth of what the thread that draws does in a pane where nothing changes.
        screen = self._app.screen_stack[0]
        within = screen.focused.ancestors if screen.focused is not None else screen.walk_children(Prompt)
        found: list[Requester[Any]] = [each for each in within if isinstance(each, Prompt) and each.is_open]
        if isinstance(self._app.screen, QuestionScreen):
            found.append(self._app.screen)
        return found
