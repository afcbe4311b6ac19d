"""A read-only console: every request that would change something is refused with the reason."""

from __future__ import annotations

import shlex
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from dataclasses import replace

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.command_line import CommandLine, Stream
from bot_console.tui.console.connection.no_console import NoConsole, done
from bot_console.tui.console.model import Capabilities, ConsoleSnapshot, LaunchArgument
from bot_console.tui.console.protocol import Console
from bot_console.tui.console.recording import Recording
from bot_console.tui.console.sensors.model import Sensors
from bot_console.tui.console.topics.reading import ReadingTraffic
from bot_console.tui.console.traffic import Traffic

WHY = "this console is read-only (--read-only)"

READING: Mapping[str, frozenset[str]] = {
    "action": frozenset(("info", "list", "type")),
    "component": frozenset(("list", "types")),
    "interface": frozenset(("list", "package", "packages", "proto", "show")),
    "lifecycle": frozenset(("get", "list", "nodes")),
    "node": frozenset(("info", "list")),
    "param": frozenset(("describe", "get", "list")),
    "pkg": frozenset(("executables", "list", "prefix", "xml")),
    "service": frozenset(("find", "info", "list", "type")),
    "topic": frozenset(("bw", "delay", "echo", "find", "hz", "info", "list", "type")),
}
"""Lines that change nothing: commands with their harmless subcommands."""


class ReadOnlyConsole(NoConsole):
    """Reads, plots and saves to files; the only request it sends is to stop the robot, which anyone may do."""

    def __init__(self, console: Console, report: Callable[[str], None]) -> None:
        """`report` receives refusals of requests that return no answer."""
        super().__init__(WHY, console)
        self._console = console
        self._report = report
        self._seen = self._shown = ConsoleSnapshot()
        self._can, self._cannot = Capabilities(), Capabilities(change=WHY)
        self.snapshot = self._last_poll

    def _last_poll(self) -> ConsoleSnapshot:
        """The newest snapshot, marked as read-only; the same object when nothing changed."""
        seen = self._console.snapshot()
        if seen.capabilities is not self._can:
            self._can, self._cannot = seen.capabilities, replace(seen.capabilities, change=WHY)
        if seen is not self._seen:
            drive = replace(seen.drive, refused=WHY)
            self._seen, self._shown = seen, replace(seen, drive=drive, capabilities=self._cannot)
        return self._shown

    @property
    def recording(self) -> Recording:
        """Records into bags."""
        return self._console.recording

    @property
    def traffic(self) -> Traffic:
        """Shows topics; refuses to send messages."""
        return ReadingTraffic(WHY, self._console.traffic)

    @property
    def sensors(self) -> Sensors:
        """The robot's sensor data."""
        return self._console.sensors

    def watch(self, path: str, requester: str = "") -> Answer:
        """Collect a series."""
        return self._console.watch(path, requester)

    def unwatch(self, path: str, requester: str = "") -> None:
        """Stop collecting a series."""
        self._console.unwatch(path, requester)

    def clear_logs(self) -> None:
        """Discard this console's log records."""
        self._console.clear_logs()

    def fetch_profile(self, address: str) -> Future[Answer]:
        """Download a parameter file and add it as a profile, to see what it would change."""
        return self._console.fetch_profile(address)

    def open_profile(self, path: str) -> Answer:
        """Add a file as a profile, to see what it would change."""
        return self._console.open_profile(path)

    def save_profile(self, name: str, description: str = "") -> Answer:
        """Save the current values as a profile."""
        return self._console.save_profile(name, description)

    def rename_profile(self, name: str, to: str) -> Answer:
        """Rename a profile."""
        return self._console.rename_profile(name, to)

    def delete_profile(self, name: str) -> Answer:
        """Delete the file of a profile."""
        return self._console.delete_profile(name)

    def save_parameters(self, path: str, nodes: Sequence[str] = (), *, only_changed: bool = False) -> Answer:
        """Write a parameter file."""
        return self._console.save_parameters(path, nodes, only_changed=only_changed)

    def all_stop(self, hold: bool = True, reason: str = "ALL STOP") -> None:
        """Lock the robot's emergency stop; releasing it is refused."""
        if hold:
            self._console.all_stop(True, reason)
        else:
            self._report(f"the robot stays locked: {WHY}")

    def hold_early(self, press: str) -> None:
        """Stop the robot for a key press that is not processed yet."""
        self._console.hold_early(press)

    def settle_early(self, press: str, *, keep: bool) -> None:
        """Keep that stop, or withdraw it because the key was not a stop."""
        self._console.settle_early(press, keep=keep)

    def release(self, others: Sequence[str]) -> None:
        """Refused."""
        self.all_stop(False)

    def close(self) -> None:
        """Close the console."""
        self._console.close()


class ReadOnlyLauncher:
    """Refuses to start or end processes."""

    def launch(self, path: str, arguments: Mapping[str, str]) -> Future[Answer]:
        """Refused."""
        return done(Answer(False, WHY))

    def arguments(self, path: str) -> Sequence[LaunchArgument]:
        """Refused: raises `ValueError`."""
        raise ValueError(WHY)

    def files(self) -> Sequence[str]:
        """None."""
        return ()

    def start(self, key: str) -> Future[Answer]:
        """Refused."""
        return done(Answer(False, WHY))

    def stop(self, key: str) -> Future[Answer]:
        """Refused."""
        return done(Answer(False, WHY))

    def kill(self, key: str) -> Future[Answer]:
        """Refused."""
        return done(Answer(False, WHY))

    def restart(self, key: str) -> Future[Answer]:
        """Refused."""
        return done(Answer(False, WHY))


class ReadOnlyCommandLine:
    """Runs lines that change nothing."""

    def __init__(self, lines: CommandLine) -> None:
        self._lines = lines

    def stream(self, line: str) -> Stream | None:
        """Start a line that keeps printing; all lines of that kind only read."""
        return self._lines.stream(line)

    def commands(self) -> Sequence[str]:
        """The commands that a line may begin with."""
        return self._lines.commands()

    def complete(self, words: Sequence[str], snapshot: ConsoleSnapshot) -> Future[Sequence[str]]:
        """Completions of the last word."""
        return self._lines.complete(words, snapshot)

    def run(self, line: str) -> Future[str]:
        """Run a line that only reads; print a refusal for any other."""
        try:
            words = shlex.split(line)
        except ValueError:
            return self._lines.run(line)  # prints what is wrong with the line
        words = words[1:] if words[:1] == ["ros2"] else words
        reads = len(words) > 1 and words[1] in READING.get(words[0], ())
        return self._lines.run(line) if reads or len(words) == 1 else done(f"refused: {WHY}")
