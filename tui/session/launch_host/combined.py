"""Combines several launch hosts to one launcher: those that this console has started, and those of other programs."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from dataclasses import dataclass

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.command_gate import done
from bot_console.tui.console.in_background import in_background
from bot_console.tui.console.launch.launcher import CLOSED
from bot_console.tui.console.launch.process_verbs import ProcessVerbs
from bot_console.tui.console.model import LaunchArgument, LaunchInfo
from bot_console.tui.session.launch_host.merged import SEPARATOR, MergedInfo
from bot_console.tui.session.launch_host.proxy import HostedLauncher

HOSTS_POLL_S = 1.0
"""Seconds between two searches for hosts of other programs."""
CLOSE_TIMEOUT_S = 15.0
"""Seconds that launched processes may take to end."""

Start = Callable[[], "tuple[str, HostedLauncher]"]
"""Starts a host of this console; returns its name, which is the path of its socket if it has one, and the connection to
it.
"""


@dataclass(frozen=True)
class OtherHosts:
    """How to find the hosts of other programs: `addresses` lists the sockets of all hosts, `enter` connects to one.

    `enter` returns None if the host has gone. The search begins once `ready` has returned, which may block.
    """

    addresses: Callable[[], Sequence[str]]
    enter: Callable[[str], HostedLauncher | None]
    ready: Callable[[], object] = lambda: None


class CombinedLauncher(ProcessVerbs):
    """A launcher over several hosts. Methods may be called from any thread."""

    def __init__(
        self, start: Start, files: Callable[[], Sequence[str]], others: OtherHosts | None = None, *, reuse: bool = True
    ) -> None:
        """Without `reuse`, each launch file gets a separate host; otherwise all share one, which is started when it is
        first needed.
        """
        self._start = start
        self._files = files
        self._reuse = reuse
        self._lock = threading.RLock()
        self._starting = threading.Lock()
        """Held while a host is started, which takes seconds: never acquire it while holding `_lock` or from the drawing
        thread.
        """
        self._own: dict[str, HostedLauncher] = {}
        self._used: set[str] = set()
        self._others: dict[str, HostedLauncher] = {}
        self._merged = MergedInfo()
        self._over = threading.Event()
        if others is not None:
            threading.Thread(target=self._search, args=(others,), name="launch hosts", daemon=True).start()

    def _search(self, others: OtherHosts) -> None:
        others.ready()
        while not self._over.is_set():
            for address in others.addresses():
                if not self._is_known(address) and (launcher := others.enter(address)) is not None:
                    self._add_other(address, launcher)
            self._over.wait(HOSTS_POLL_S)

    def _is_known(self, address: str) -> bool:
        return address in self._others or address in self._own

    def _add_other(self, address: str, launcher: HostedLauncher) -> None:
        with self._lock:
            if not self._over.is_set() and not self._is_known(address):
                self._others[address] = launcher
                return
        launcher.close()

    def info(self) -> LaunchInfo:
        """The merged state of all hosts; the same object until something changes."""
        with self._lock:
            gone = [address for address, each in self._others.items() if each.is_gone]
            for address in gone:
                number = address.rpartition("/")[2].partition(".")[0]
                self._merged.forget(
                    address, f"the launch host {number} has gone: everything it had started has ended with it"
                )
                del self._others[address]
            return self._merged.merge({name: each.info() for name, each in (*self._others.items(), *self._own.items())})

    def _free_host(self, *, use: bool) -> HostedLauncher | None:
        """A host of this console that can take another launch; with `use`, it is reserved for that launch."""
        with self._lock:
            for name, each in self._own.items():
                if not each.is_gone and (self._reuse or name not in self._used):
                    self._used |= {name} if use else set()
                    return each
        return None

    def launch(self, path: str, arguments: Mapping[str, str]) -> Future[Answer]:
        """Run another launch file, which ends with this console; if a host has to be started, this happens in the
        background.
        """
        if self._over.is_set():
            return done(Answer(False, CLOSED))
        if (free := self._free_host(use=True)) is not None:
            return free.launch(path, arguments)

        def start() -> Answer:
            try:
                return self._host(use=True).launch(path, arguments).result()
            except Exception as error:  # whatever has kept the host from starting
                return Answer(False, str(error))

        return in_background(start, "launch host")

    def arguments(self, path: str) -> Sequence[LaunchArgument]:
        """The arguments that a launch file declares; raises `ValueError` if it cannot be read."""
        return self._host(use=False).arguments(path)

    def files(self) -> Sequence[str]:
        """The launch files to choose from."""
        return self._files()

    def _request(self, verb: str, key: str) -> Future[Answer]:
        name, _, its_key = key.rpartition(SEPARATOR)
        with self._lock:
            launcher = self._own.get(name) or self._others.get(name)
        if launcher is None:
            return done(Answer(False, f"there is no process {its_key}: the launch host that started it is gone"))
        outcome: Future[Answer] = getattr(launcher, verb)(its_key)
        return outcome

    def _host(self, *, use: bool) -> HostedLauncher:
        """Return a host like `_free_host`, but start one if there is none.

        Raises `ValueError` if none can be started, or when the console is closing.
        """
        with self._starting:
            return self._free_host(use=use) or self._start_own(use=use)

    def _start_own(self, *, use: bool) -> HostedLauncher:
        if self._over.is_set():
            raise ValueError(CLOSED)
        try:
            name, launcher = self._start()
        except Exception as error:  # whatever it is, the console continues without the launch
            raise ValueError(f"no launch host could be started: {error}") from error
        with self._lock:
            self._own[name] = launcher
            self._used |= {name} if use else set()
            # the search had found the host's socket before this console knew that the host is its own
            twice = self._others.pop(name, None)
            over = self._over.is_set()
        if twice is not None:
            twice.close()
        if over:
            launcher.close()
        return launcher

    def close(self) -> None:
        """End what this console has started, and disconnect from all hosts."""
        self._over.set()
        with self._lock:
            launchers = [*self._own.values(), *self._others.values()]
        threads = [threading.Thread(target=each.close, name="closing", daemon=True) for each in launchers]
        for each in threads:
            each.start()
        for each in threads:
            each.join(CLOSE_TIMEOUT_S)
