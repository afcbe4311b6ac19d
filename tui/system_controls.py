"""The objects that act on a system, made once it is connected: command line, stopping, fault handling, quitting,
suspending.

The app imports this module only after its first frame: it imports the whole model, which would delay the frame by a
third.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from bot_console.tui.arrangement.faults import FaultHandler
from bot_console.tui.arrangement.pane_maker import PaneMaker
from bot_console.tui.arrangement.rqt_command_line import Opening
from bot_console.tui.arrangement.stage import Stage
from bot_console.tui.commanding.command_handler import CommandHandler
from bot_console.tui.commanding.recording import BagRecording
from bot_console.tui.console.command_line import CommandLine
from bot_console.tui.console.gated_command_line import GatedCommandLine
from bot_console.tui.console.protocol import Console
from bot_console.tui.panes.time_cursor import TimeCursor
from bot_console.tui.safety.early_stop import EarlyStop
from bot_console.tui.safety.quitting import Quitting
from bot_console.tui.safety.safety_announcements import SafetyAnnouncements
from bot_console.tui.safety.stopping import Stopping
from bot_console.tui.screens.opener import ScreenOpener
from bot_console.tui.terminal.suspension import TerminalHandover
from bot_console.tui.widgets.status_bar import StatusBar
from textual.app import App


@dataclass(frozen=True)
class Controls:
    """One object for each thing that a person can do with a system or has to be told about it."""

    quitting: Quitting
    stopping: Stopping
    leaving: TerminalHandover
    commands: CommandHandler
    recording: BagRecording
    screens: ScreenOpener
    panes: PaneMaker
    faults: FaultHandler
    safety_announcements: SafetyAnnouncements
    status: StatusBar


def controls_of(
    app: App[None],
    stage: Stage,
    console: Console,
    lines: CommandLine | None,
    *,
    early_stop: EarlyStop,
    time_cursor: TimeCursor,
    redraw: Callable[[], None],
    open: Callable[[Opening], None],
    changed: Callable[[], None],
) -> Controls:
    """Create the controls of an app for a console.

    `redraw` sends every cell again, `open` shows an opening, and `changed` is called after a pane was replaced.
    """
    quitting = Quitting(app, console)
    stopping = Stopping(app, console, quitting, stage.typing, stage.hides_stops)
    early_stop.attach(console.drive, stopping.on_early_key, lambda: console.snapshot().drive.own_stops)
    leaving = TerminalHandover(app, console, redraw, holds=not console.gate.read_only)
    gated = GatedCommandLine(console.gate, lines)
    panes = PaneMaker(console, time_cursor, stage.entries)
    return Controls(
        quitting=quitting,
        stopping=stopping,
        leaving=leaving,
        commands=CommandHandler(app, stage, stopping, console, gated, open, leaving.run),
        recording=BagRecording(console.bags),
        screens=ScreenOpener(app, stage),
        panes=panes,
        faults=FaultHandler(app, panes, changed),
        safety_announcements=SafetyAnnouncements(console.parameters),
        status=StatusBar(),
    )
