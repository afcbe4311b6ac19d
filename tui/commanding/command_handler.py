"""Carries out commands from the palette and the command line, and their effects on the screen."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

from bot_console.tui.arrangement.rqt_command_line import Opening
from bot_console.tui.arrangement.stage import Stage
from bot_console.tui.child_command import child_command
from bot_console.tui.commanding.completion import Completion
from bot_console.tui.commanding.palette import Command, all_commands, options_for
from bot_console.tui.commanding.runner import LineRunner
from bot_console.tui.console.command_line import CommandLine, Stream
from bot_console.tui.console.protocol import Console
from bot_console.tui.layout.built_in import OVERVIEW
from bot_console.tui.panes.pane import Pane
from bot_console.tui.safety.line_risk import risk_of
from bot_console.tui.safety.stopping import Stopping
from bot_console.tui.screens.question_screens import screen_for
from bot_console.tui.widgets.command_line import CommandField
from bot_console.tui.widgets.prompt.question import Choice, Option
from bot_console.tui.widgets.streams.panel import StreamPanel
from bot_console.tui.widgets.streams.panels import StreamPanels
from textual.app import App


class CommandHandler:
    """Takes commands from a person and carries them out; implements `tui.commanding.runner.Host`."""

    def __init__(
        self,
        app: App[None],
        stage: Stage,
        stopping: Stopping,
        console: Console,
        lines: CommandLine,
        open: Callable[[Opening], None],
        run_outside: Callable[[Sequence[str]], int],
    ) -> None:
        """`run_outside` hands the terminal to a program until it ends, and returns its exit code."""
        self._app = app
        self._stage = stage
        self._stopping = stopping
        self._console = console
        self._open = open
        self._run_outside = run_outside
        self.runner = LineRunner(self, console, lines)
        self._completion = Completion(self.runner.offered)

    def field(self) -> CommandField:
        """The command line's widget."""
        return CommandField(self.runner, self._completion)

    def ask_line(self) -> None:
        """Open the command line."""
        self._app.screen_stack[0].query_one(CommandField).open()

    def poll(self) -> None:
        """Show new output of the command line and of the lines below the panes; called now and then."""
        # Both are direct children of the screen: a search through everything below it, ten times a second, takes a
        # tenth of the drawing thread's time.
        for each in self._app.screen_stack[0].children:
            if isinstance(each, (StreamPanels, CommandField)):
                each.poll()

    def palette(self) -> None:
        """Open the palette, which finds actions and runs command lines."""
        known = {**all_commands(self._app, self._stage.current(), self._show_pane), **self._plugins()}
        self._app.push_screen(
            screen_for(
                Choice(
                    "Commands",
                    lambda chosen: known[chosen].run() if chosen in known else self.runner.run(chosen),
                    find=partial(options_for, known, lambda line: risk_of(line, self._console.snapshot())),
                    hint="type a command, or a line of ros2",
                    empty="No command matches; a line that begins with ros2 is run.",
                )
            )
        )

    def _show_pane(self, name: str) -> Pane | None:
        """Show a pane and return it, if it can be shown."""
        self._stage.go(name)
        return next((each for each in self._stage.panes() if each.id == name), None)

    def _plugins(self) -> Mapping[str, Command]:
        return {
            each.id: Command(f"Pane: {each.title}", "", partial(self._stage.go, each.id))
            for each in self._stage.plugins
        }

    def notify(self, message: str, *, severity: Any = "information", title: str = "") -> None:
        """Show a notification."""
        self._app.notify(message, severity=severity, title=title)

    def push_screen(self, screen: Any, /) -> None:
        """Put a screen over the panes."""
        self._app.push_screen(screen)

    def call_later(self, callback: Callable[..., Any], /, *args: Any) -> object:
        """Call back on the thread that draws."""
        return self._app.call_later(callback, *args)

    def open(self, opening: Opening) -> None:
        """Show a pane with the requested curves or node."""
        self._open(opening)

    def show_stream(self, line: str, stream: Stream) -> None:
        """Show a command line that keeps running below the panes."""
        self._streams().begin(line, stream)

    def stream_problem(self, words: Sequence[str]) -> str:
        """Why a `ros2` line (given without that word) has no room below the panes; empty if it has."""
        return self._streams().problem(words)

    def end_stream(self) -> None:
        """Stop the command line below the panes; if there are several, ask which."""
        streams = self._streams()
        if len(streams.panels) > 1:
            self._app.push_screen(screen_for(which_stream(streams)))
        elif streams.panels:
            streams.end(streams.panels[0])

    def _streams(self) -> StreamPanels:
        return self._app.screen_stack[0].query_one(StreamPanels)

    def load_layout(self, name: str) -> None:
        """Show a layout."""
        self._stage.go(OVERVIEW)
        self._stage.arranging.load(name)

    def layouts(self) -> Sequence[str]:
        """The names of the layouts."""
        return sorted(self._stage.arranging.arrangement.layouts())

    def show_bag(self, folder: str, *, play: bool) -> None:
        """Show or play a bag in a separate console, which takes over the terminal until it quits."""
        options = [*["--play"] * play, *self._console.snapshot().capabilities.bag_options]
        if self._run_outside([*child_command("bot_console.tui"), "bag", "open", folder, *options]):
            self.notify(f"{folder} cannot be shown; bot-console bag info {folder} says why", severity="error")

    def hold_robot(self, hold: bool) -> None:
        """Stop and hold the robot, or release it; asks first if others hold it too."""
        (self._stopping.hold if hold else self._stopping.release)()


ALL = "all"


def which_stream(streams: StreamPanels) -> Choice:
    """The question which line to stop; if the chosen one has ended meanwhile, no other is stopped instead."""
    offered = {str(number): each for number, each in enumerate(streams.panels, 1)}

    def find(typed: str) -> Sequence[Option]:
        options = [Option(f"{number} {each.line}", each.state, number) for number, each in offered.items()]
        options.append(Option("all of them", value=ALL))
        named = [each for each in options if each.value == typed.strip()]
        return named or [each for each in options if all(word in each.title for word in typed.split())]

    def end(chosen: str) -> None:
        panels: Sequence[StreamPanel] = [*offered.values()] if chosen == ALL else [offered[chosen]]
        for each in panels:
            streams.end(each)

    return Choice("End which line?", end, find=find, hint="type its number, or part of it", empty="No line matches.")
