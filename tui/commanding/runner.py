"""Runs typed command lines according to their first word, or reports what to type instead."""

from __future__ import annotations

import shlex
import time
from collections.abc import Callable, Sequence
from concurrent.futures import Future
from difflib import get_close_matches
from typing import Any, Protocol

from bot_console.tui.arrangement.rqt_command_line import RQT_PANES, Opening, is_rqt, parse_rqt_command
from bot_console.tui.commanding.verbs import VERBS, bag_problem, parse_setting, places, split_curves, usage_problem
from bot_console.tui.console.answer import Answer, answer_of
from bot_console.tui.console.command_gate import done
from bot_console.tui.console.command_line import CommandLine, Stream
from bot_console.tui.console.model import ChangeSource, SetOutcome
from bot_console.tui.console.protocol import Console
from bot_console.tui.safety.line_risk import risk_of
from bot_console.tui.screens.output import OutputScreen
from bot_console.tui.text.refusals import of_one
from bot_console.tui.text.sanitize import sanitize
from bot_console.tui.text.value_text import value_text

STAMP = "%Y_%m_%d-%H_%M_%S"
"""Time stamp in the name of a bag's folder, as in `ros2 bag record`."""

OF_EVERY_ROS2 = ("component", "launch", "pkg", "run")
"""Commands that are missing only if a machine has an `rclpy` without a `ros2`."""


class Host(Protocol):
    """The operations on the screen that command lines need."""

    def notify(self, message: str, *, severity: Any = ..., title: str = ...) -> None:
        """Show a notification."""
        ...

    def push_screen(self, screen: Any, /) -> object:
        """Put a screen over the panes."""
        ...

    def call_later(self, callback: Callable[..., Any], /, *args: Any) -> object:
        """Call back on the thread that draws."""
        ...

    def open(self, opening: Opening) -> None:
        """Show a pane with the requested curves or node."""
        ...

    def show_stream(self, line: str, stream: Stream) -> None:
        """Show a command line that keeps running below the panes."""
        ...

    def stream_problem(self, words: Sequence[str]) -> str:
        """Why a `ros2` line (given without that word) has no room below the panes; empty if it has."""
        ...

    def load_layout(self, name: str) -> None:
        """Show a layout; raises `LookupError` if there is none of that name."""
        ...

    def layouts(self) -> Sequence[str]:
        """The names of the layouts."""
        ...

    def show_bag(self, folder: str, *, play: bool) -> None:
        """Show or play a bag in a console that takes the whole terminal until it quits."""
        ...

    def hold_robot(self, hold: bool) -> None:
        """Stop and hold the robot, or release it; asks first if others hold it too."""
        ...


class LineRunner:
    """Runs lines, and finds their mistakes beforehand."""

    def __init__(self, host: Host, console: Console, lines: CommandLine) -> None:
        self._host = host
        self._console = console
        self._lines = lines

    def wrong(self, line: str) -> str:
        """The mistake in a line, and how to fix it; empty if no mistake is found."""
        try:
            words = shlex.split(line)
        except ValueError:
            return "a quotation mark is not closed"
        if not words:
            return ""
        if words[0] in VERBS:
            return self._wrong_verb(words)
        verb = words[1] if words[0] == "ros2" and len(words) > 1 else words[0]
        known = [*VERBS, *RQT_PANES, "ros2", *self._lines.commands()]
        if verb in known or is_rqt(words):
            return self._host.stream_problem(words[words[0] == "ros2" :])
        if verb in OF_EVERY_ROS2:
            instead = "o in the Launch pane opens launch files; " if verb == "launch" else ""
            return f"this machine has no ros2: {instead}here are {', '.join(self._lines.commands())}"
        like = get_close_matches(verb, known, 1, 0.6)
        hint = f"did you mean {like[0]}?" if like else "help lists the commands, ^p finds an action by name"
        return f"there is no command {verb}; {hint}"

    def _wrong_verb(self, words: Sequence[str]) -> str:
        wrong = usage_problem(words)
        if not wrong and words[0] == "set":
            try:
                parse_setting(words[1:], self._console.snapshot())
            except ValueError as error:
                return str(error)
        if not wrong and words[0] == "layout" and words[1] not in self._host.layouts():
            return f"there is no layout {words[1]}; there are {', '.join(self._host.layouts())}"
        if not wrong and words[0] == "help" and len(words) > 1 and words[1] not in VERBS:
            return f"the console has no command {words[1]}; ros2 {words[1]} -h explains those of ros2"
        if not wrong and words[0] == "bag":
            return bag_problem(words)
        return wrong

    def preview(self, line: str) -> str:
        """How a line would make the robot less safe, or else the usage of its verb."""
        words = line.split()
        as_set = ["ros2", "param", *words] if words[:1] == ["set"] else words
        full = as_set if as_set[:1] == ["ros2"] else ["ros2", *as_set]
        why = risk_of(" ".join(full), self._console.snapshot())
        if why:
            return f"⚠ {why}"
        return VERBS[words[0]].usage if words and words[0] in VERBS else ""

    def offered(self, words: Sequence[str]) -> Future[Sequence[str]]:
        """Candidates for the last word, which may be empty."""
        *before, begun = words
        if before and before[0] in VERBS:
            snapshot, layouts, paths = self._console.snapshot(), self._host.layouts, self._console.plots.plottable
            return done(places(before, snapshot, layouts, paths))
        own = [] if before else [*VERBS, "ros2", *RQT_PANES]
        if not before and not begun:
            return done([*own, *self._lines.commands()])
        return self._lines.complete(words, self._console.snapshot())

    def run(self, line: str) -> None:
        """Run a line, or report what is wrong with it."""
        wrong = self.wrong(line)
        if wrong:
            self._host.notify(wrong, severity="error")
            return
        words = shlex.split(line)
        if words and words[0] in VERBS:
            getattr(self, f"_{words[0]}")(words[1:])
        elif is_rqt(words):
            self._open(words)
        elif words:
            self._ros2(line)

    def _open(self, words: Sequence[str]) -> None:
        opening, left = parse_rqt_command(words)
        notes = [*opening.notes, *(f"{each} is ignored" for each in left)]
        if opening.perspective:
            file = opening.perspective
            notes.append(f"perspective {file} can only be opened at the start: bot-console --perspective-file {file}")
        self._host.open(opening._replace(notes=tuple(notes)))

    def _ros2(self, line: str) -> None:
        stream = self._lines.stream(line)
        if stream is not None:
            self._host.show_stream(line, stream)
            return
        answer = self._lines.run(line)
        answer.add_done_callback(lambda done: self._host.call_later(self._show_output, line, done))

    def _show_output(self, line: str, done: Future[str]) -> None:
        error = done.exception()
        printed = str(error) if error else done.result()
        words = line.split()
        starts = words[words[:1] == ["ros2"] :][:1] in (["run"], ["launch"])
        # A program that was started has no output here to read and close: the Launch pane shows it.
        if starts and len(printed.strip().splitlines()) <= 1:
            reported_text = printed.strip() or f"{line}: done, no output"
            self._host.notify(sanitize(reported_text), severity="error" if error else "information")
        else:
            self._host.push_screen(OutputScreen(line, printed))

    def _help(self, words: Sequence[str]) -> None:
        known = {name: VERBS[name] for name in (words or sorted(VERBS))}
        wide = max(len(each.usage) for each in known.values())
        lines = [f"{each.usage:<{wide}}  {each.about}" for each in known.values()]
        if not words:
            lines += ["", "Any other line is one of ros2, which need not be written:", " ".join(self._lines.commands())]
            lines += ["and the programs of rqt, which open panes:", " ".join(RQT_PANES)]
        self._host.push_screen(OutputScreen("help", "\n".join(lines)))

    def _layout(self, words: Sequence[str]) -> None:
        self._host.load_layout(words[0])

    def _bag(self, words: Sequence[str]) -> None:
        self._host.show_bag(words[1], play=words[0] == "play")

    def _plot(self, words: Sequence[str]) -> None:
        self._host.open(Opening("plot", tuple(split_curves(words))))

    def _stop(self, _: Sequence[str]) -> None:
        self._host.hold_robot(True)

    def _release(self, _: Sequence[str]) -> None:
        self._host.hold_robot(False)

    def _set(self, words: Sequence[str]) -> None:
        wanted = parse_setting(words, self._console.snapshot())
        answer = self._console.parameters.set(wanted.node, {wanted.name: wanted.value}, ChangeSource.EDIT)
        answer.add_done_callback(lambda done: self._host.call_later(self._report_set, done))

    def _report_set(self, done: Future[tuple[SetOutcome, ...]]) -> None:
        error = done.exception()
        for each in () if error else done.result():
            if each.accepted:
                self._host.notify(f"{each.node} {each.name} = {value_text(each.value)}")
            else:
                self._host.notify(of_one(each), severity="error")
        if error:
            self._host.notify(sanitize(str(error)), severity="error")

    def _record(self, words: Sequence[str]) -> None:
        recording = self._console.bags
        folder = recording.info.folder
        if [*words] == ["stop"]:
            if folder:
                self._report_later(recording.stop())
            else:
                self._host.notify("Nothing is recorded; record begins it.")
        elif folder:
            self._host.notify(f"{folder} is being recorded; record stop ends it.", severity="warning")
        else:
            self._report_later(recording.start(words[0] if words else f"rosbag2_{time.strftime(STAMP)}"))

    def _report_later(self, answer: Future[Answer]) -> None:
        answer.add_done_callback(lambda done: self._host.call_later(self._report, done))

    def _report(self, done: Future[Answer]) -> None:
        answer = answer_of(done)
        self._host.notify(answer.text, severity="information" if answer.ok else "error")
