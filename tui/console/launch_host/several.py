"""The launch hosts of a domain as one launcher: those of other consoles, and this console's own."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from dataclasses import replace

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.connection.no_console import done
from bot_console.tui.console.launch.process_verbs import ProcessVerbs
from bot_console.tui.console.launch.timeline import KEPT
from bot_console.tui.console.launch_host.proxy import HostedLauncher
from bot_console.tui.console.model import LaunchArgument, LaunchEvent, LaunchInfo, ProcessInfo

LOOK_S = 1.0
"""Seconds between two looks for hosts that have come."""

Open = Callable[[str], "HostedLauncher | None"]
"""Connects to a host by its door; None where nobody is behind it."""


class SeveralLaunchers(ProcessVerbs):
    """One launcher over several hosts. Methods may be called from any thread."""

    def __init__(
        self,
        own: Callable[[], HostedLauncher],
        files: Callable[[], Sequence[str]],
        doors: Callable[[], Sequence[str]],
        open_door: Open,
        ready: Callable[[], object] = lambda: None,
    ) -> None:
        """`own` starts the host for what this console launches, when it first does; `doors` finds those of others.

        They are looked for as soon as `ready`, which may wait, has returned.
        """
        self._make_own = own
        self._files = files
        self._doors = doors
        self._open = open_door
        self._lock = threading.RLock()
        self._making = threading.Lock()
        """Held while the own host is started, which takes seconds: never by whoever holds `_lock`, or draws."""
        self._own: HostedLauncher | None = None
        self._others: dict[str, HostedLauncher] = {}
        self._merged = _Merged()
        self._over = threading.Event()
        threading.Thread(target=self._look, args=(ready,), name="launch hosts", daemon=True).start()

    def _look(self, ready: Callable[[], object]) -> None:
        ready()
        while not self._over.is_set():
            for door in self._doors():
                if door not in self._others:
                    self._connect(door)
            self._over.wait(LOOK_S)

    def _connect(self, door: str) -> None:
        launcher = self._open(door)
        if launcher is None:
            return
        with self._lock:
            if not self._over.is_set():
                self._others[door] = launcher
                return
        launcher.close()

    def info(self) -> LaunchInfo:
        """The state of all of them; the same object until something changes."""
        with self._lock:
            gone = [door for door, each in self._others.items() if each.is_gone]
            for door in gone:
                self._merged.forget(door, "what it had started has ended with it")
                del self._others[door]
            infos = {door: each.info() for door, each in self._others.items()}
            if self._own is not None:
                infos[""] = self._own.info()
            return self._merged.of(infos)

    def launch(self, path: str, arguments: Mapping[str, str]) -> Future[Answer]:
        """Run another launch file, which ends with this console; the first one starts a host in the background."""
        with self._lock:
            own = self._own
        if own is not None:
            return own.launch(path, arguments)
        outcome: Future[Answer] = Future()

        def start() -> None:
            try:
                outcome.set_result(self._mine().launch(path, arguments).result())
            except Exception as error:  # the border of the thread
                outcome.set_result(Answer(False, f"no launch host could be started: {error}"))

        threading.Thread(target=start, name="launch host", daemon=True).start()
        return outcome

    def arguments(self, path: str) -> Sequence[LaunchArgument]:
        """The arguments a launch file declares; raises `ValueError` when it cannot be read."""
        return self._mine().arguments(path)

    def files(self) -> Sequence[str]:
        """Launch files of the workspace."""
        return self._files()

    def _want(self, verb: str, key: str) -> Future[Answer]:
        door, _, its_key = key.rpartition(SEPARATOR)
        with self._lock:
            launcher = self._others.get(door) if door else self._own
        if launcher is None:
            return done(Answer(False, f"there is no process {its_key}: what has started it is gone"))
        outcome: Future[Answer] = getattr(launcher, verb)(its_key)
        return outcome

    def _mine(self) -> HostedLauncher:
        with self._making:
            if self._own is None:
                made = self._make_own()
                with self._lock:
                    self._own = made
                    over = self._over.is_set()
                if over:  # the console was closed meanwhile
                    made.close()
            return self._own

    def close(self) -> None:
        """End what this console has started, and disconnect from the other hosts."""
        self._over.set()
        with self._lock:
            launchers = [*([self._own] if self._own else []), *self._others.values()]
        for each in launchers:
            each.close()


SEPARATOR = "|"
"""Between a door and the key that a host has for a process."""


class _Merged:
    """The states of several hosts as one: keys prefixed by door, events renumbered in order of arrival."""

    def __init__(self) -> None:
        self._infos: dict[str, LaunchInfo] = {}
        self._seen: dict[str, int] = {}
        self._info = LaunchInfo()

    def forget(self, door: str, why: str) -> None:
        """Remove a host."""
        self._infos = {}  # what comes next differs from it, or is empty, too
        self._seen.pop(door, None)
        number = door.rpartition("/")[2].partition(".")[0]
        stamp = self._info.timeline[-1].stamp if self._info.timeline else 0
        self._add([LaunchEvent(0, stamp, f"the launch host {number} has gone: {why}")])

    def of(self, infos: Mapping[str, LaunchInfo]) -> LaunchInfo:
        """The merged state; the same object if nothing is new."""
        same = infos.keys() == self._infos.keys() and all(infos[door] is self._infos[door] for door in infos)
        if same and (infos or not self._info.processes):
            return self._info
        self._infos = dict(infos)
        news: list[LaunchEvent] = []
        for door, info in infos.items():
            news += [each for each in info.timeline if each.seq > self._seen.get(door, -1)]
            if info.timeline:
                self._seen[door] = info.timeline[-1].seq
        self._info = LaunchInfo(
            tuple(file for each in infos.values() for file in each.files),
            tuple(_keyed(door, process) for door, each in infos.items() for process in each.processes),
            self._info.timeline,
            next((each.problem for each in infos.values() if each.problem), ""),
            sum(each.delayed for each in infos.values()),
        )
        self._add(sorted(news, key=lambda each: each.stamp))
        return self._info

    def _add(self, events: Sequence[LaunchEvent]) -> None:
        first = self._info.timeline[-1].seq + 1 if self._info.timeline else 0
        numbered = (replace(each, seq=first + at) for at, each in enumerate(events))
        self._info = replace(self._info, timeline=(*self._info.timeline, *numbered)[-KEPT:])


def _keyed(door: str, process: ProcessInfo) -> ProcessInfo:
    return replace(process, key=f"{door}{SEPARATOR}{process.key}")
