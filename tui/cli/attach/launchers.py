"""The launches of a console on a real ROS 2: one host process per launch file, combined into a single launcher."""

from __future__ import annotations

import itertools
import socket
import subprocess
import threading
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from dataclasses import replace

from bot_console.tui.cli.attach.launch_files import LaunchFiles
from bot_console.tui.cli.attach.launch_host import start_host
from bot_console.tui.cli.live.launch_lines import teller
from bot_console.tui.console.answer import Answer
from bot_console.tui.console.connection.no_console import done
from bot_console.tui.console.launch.launcher import CLOSED
from bot_console.tui.console.launch.process_output import Add
from bot_console.tui.console.launch.process_verbs import ProcessVerbs
from bot_console.tui.console.launch.timeline import KEPT
from bot_console.tui.console.launch_host.proxy import HostedLauncher
from bot_console.tui.console.model import LaunchArgument, LaunchEvent, LaunchInfo, ProcessInfo

Start = Callable[[], tuple["subprocess.Popen[bytes]", socket.socket]]
PATIENCE = 15.0
"""Seconds for all that was launched to end."""


class _Host:
    """A host process and its last known state."""

    def __init__(self, number: int, start: Start, record: Add, printed: Callable[[int, str, str], None]) -> None:
        self.number = number
        self.used = False
        self.process, connection = start()
        self.launcher = HostedLauncher(connection, record, printed)
        self.known: LaunchInfo | None = None
        self.next_event = 0
        threading.Thread(target=self._read, args=(teller(printed),), name="launch output", daemon=True).start()

    def _read(self, tell: Callable[[str], None]) -> None:
        with self.process.stdout or open("/dev/null", "rb") as lines:
            for line in lines:
                tell(line.decode("utf-8", "replace"))
        self.process.wait()

    def mine(self, process: ProcessInfo) -> ProcessInfo:
        """A process, under a key that is unique among hosts."""
        return replace(process, key=f"{self.number}:{process.key}")


class HostLaunchers(ProcessVerbs):
    """The `Launcher` that combines them; methods may be called from any thread."""

    def __init__(self, record: Add, printed: Callable[[int, str, str], None], start: Start = start_host) -> None:
        def make(number: int) -> _Host:
            return _Host(number, start, record, printed)

        self._make = make
        self._files = LaunchFiles()
        self._closed = False
        self._numbers = itertools.count(1)
        self._lock = threading.Lock()
        self._hosts: list[_Host] = []
        self._timeline: tuple[LaunchEvent, ...] = ()
        self._events = itertools.count()
        self._info = LaunchInfo()

    def _unused(self, use: bool) -> _Host:
        """An idle host, taken for a launch if that is its `use`.

        Raises `ValueError` once it is closed.
        """
        with self._lock:
            if self._closed:
                raise ValueError(CLOSED)
            host = next((each for each in self._hosts if not each.used), None)
            if host is None:
                host = self._make(next(self._numbers))
                self._hosts.append(host)
            host.used = host.used or use
            return host

    def info(self) -> LaunchInfo:
        """What is known now; the same object until something changes."""
        with self._lock:
            infos = [(host, host.launcher.info()) for host in self._hosts]
            if all(host.known is info for host, info in infos):
                return self._info
            for host, info in infos:
                self._take_events(host, info)
                host.known = info
            self._info = LaunchInfo(
                tuple(file for _, info in infos for file in info.files),
                tuple(host.mine(each) for host, info in infos for each in info.processes),
                self._timeline,
                next((info.problem for _, info in infos[::-1] if info.problem), ""),
            )
            return self._info

    def _take_events(self, host: _Host, info: LaunchInfo) -> None:
        new = [each for each in info.timeline if each.seq >= host.next_event]
        if new:
            host.next_event = new[-1].seq + 1
            self._timeline = (*self._timeline, *(replace(each, seq=next(self._events)) for each in new))[-KEPT:]

    def launch(self, path: str, arguments: Mapping[str, str]) -> Future[Answer]:
        """Run one more launch file, in a process of its own."""
        try:
            host = self._unused(use=True)
        except ValueError as closed:
            return done(Answer(False, str(closed)))
        return host.launcher.launch(path, arguments)

    def arguments(self, path: str) -> Sequence[LaunchArgument]:
        """The arguments a launch file declares; raises `ValueError` when it cannot be read."""
        return self._unused(use=False).launcher.arguments(path)

    def files(self) -> Sequence[str]:
        """Launch files of all packages of this machine."""
        return self._files.now()

    def _want(self, verb: str, key: str) -> Future[Answer]:
        number, _, rest = key.partition(":")
        with self._lock:
            host = next((each for each in self._hosts if str(each.number) == number), None)
        if host is not None:
            outcome: Future[Answer] = getattr(host.launcher, verb)(rest)
            return outcome
        return done(Answer(False, f"there is no process {key}"))

    def close(self) -> None:
        """End everything launched from this console, and nothing else."""
        with self._lock:
            self._closed, hosts = True, list(self._hosts)
        threads = [threading.Thread(target=each.launcher.close, daemon=True) for each in hosts]
        for each in threads:
            each.start()
        for each in threads:
            each.join(PATIENCE)
