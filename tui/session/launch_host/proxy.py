"""The console's proxies for a launcher in another process, and for the traffic that it keeps in memory."""

from __future__ import annotations

import itertools
import socket
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from concurrent.futures import TimeoutError as TooLate
from dataclasses import replace
from typing import Any

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.command_gate import done
from bot_console.tui.console.launch.launcher import CLOSED
from bot_console.tui.console.launch.process import ENDED
from bot_console.tui.console.launch.process_output import Add
from bot_console.tui.console.launch.process_verbs import ProcessVerbs
from bot_console.tui.console.launch.timeline import MAX_EVENTS
from bot_console.tui.console.model import LaunchArgument, LaunchInfo, ProcessInfo, ProcessState, Severity
from bot_console.tui.console.parameters.provenance import Learn
from bot_console.tui.session.launch_host.channel import Channel, Message
from bot_console.tui.session.launch_host.plain_data import arguments_from_data, info_from_data

GONE = "the launch host has ended, and everything it had started has ended with it"
CONNECTION_POLL_S = 0.5
"""Seconds between two checks whether the host hangs."""
FILES_TIMEOUT_S = 2.0
"""Seconds to wait for the list of files; after that, it is taken to be empty."""
ARGUMENTS_TIMEOUT_S = 30.0
"""Seconds that a launch file, which is a program, may take to report its arguments."""


class HostedLauncher(ProcessVerbs):
    """A launcher that is the proxy of a launch host. Methods may be called from any thread."""

    def __init__(
        self,
        connection: socket.socket,
        record: Add,
        printed: Callable[[int, str, str], None],
        *,
        learn: Learn = lambda kind, facts: None,
        owner: bool = True,
        hangs: Callable[[], str] = lambda: "",
        thaw: Callable[[], None] = lambda: None,
    ) -> None:
        """`learn` receives what programs and launches report about parameters; `hangs` returns why the host does not
        respond.

        `thaw` resumes a frozen host that this console owns, so that it can end.

        `close` ends all processes if this console owns the host, otherwise only the connection.
        """
        self._learn = learn
        self._why_it_hangs = hangs
        self._thaw = thaw
        self._record = record
        self._printed = printed
        self._owner = owner
        self._lock = threading.Lock()
        self._numbers = itertools.count(1)
        self._asked: dict[int, Future[Message]] = {}
        self._info = self._shown = LaunchInfo()
        self._polled = 0.0
        self._hangs = ""
        self._reported: set[str] = set()
        self._closed = False
        self._ends = False
        """Whether this console is ending its host."""
        self._gone = threading.Event()
        self._channel = Channel(connection, self._received, self._lost)
        self._channel.start()

    @property
    def is_gone(self) -> bool:
        """Whether the host has ended or disconnected."""
        return self._gone.is_set()

    def info(self) -> LaunchInfo:
        """The state of the host's launches; the same object until something changes."""
        if (now := time.monotonic()) - self._polled >= CONNECTION_POLL_S:
            self._polled = now
            before, self._hangs = self._hangs, "" if self._gone.is_set() else self._why_it_hangs()
            if self._hangs != before:
                self._shown = replace(self._info, problem=self._hangs)
                if self._hangs and self._hangs not in self._reported:
                    self._reported.add(self._hangs)
                    self._printed(Severity.WARN, "launch", self._hangs)
        return self._shown if self._hangs else self._info

    def launch(self, path: str, arguments: Mapping[str, str]) -> Future[Answer]:
        """Run another launch file; the answer comes when its first process runs, or when it has failed or ended."""
        return self._request("launch", path, dict(arguments))

    def keep(self, folder: str) -> Future[Answer]:
        """Save the last minutes that the host keeps in memory as a bag."""
        return self._request("keep", folder)

    def arguments(self, path: str) -> Sequence[LaunchArgument]:
        """The arguments that a launch file declares; raises `ValueError` if it cannot be read."""
        try:
            message = self._ask("arguments", path).result(ARGUMENTS_TIMEOUT_S)
        except TooLate:
            raise ValueError(f"{path} has not reported its arguments within {ARGUMENTS_TIMEOUT_S:g} s") from None
        if "error" in message:
            raise ValueError(message["error"])
        return arguments_from_data(message["value"])

    def files(self) -> Sequence[str]:
        """The launch files of the host's workspace."""
        try:
            return tuple(self._ask("files").result(FILES_TIMEOUT_S).get("value", ()))
        except TooLate:
            return ()

    def close(self, timeout_s: float = 12.0) -> None:
        """Disconnect, within `timeout_s`; if this console owns the host, everything that runs ends."""
        with self._lock:
            if self._closed:
                return
            self._ends = True
            hangs = bool(self._hangs)
        if self._owner:
            # in any case, since a host that seems to hang may have been frozen while it held the interpreter lock
            self._thaw()
        if self._owner and not hangs:
            ended = self._ask("close")
            try:
                ended.result(timeout_s)
            except TooLate:
                self._printed(Severity.WARN, "launch", f"the launch host has not ended within {timeout_s:g} s")
        with self._lock:
            self._closed = True
        self._channel.close()
        self._gone.wait(1.0)

    def _request(self, verb: str, *words: Any) -> Future[Answer]:
        outcome: Future[Answer] = Future()

        def answered(done: Future[Message]) -> None:
            message = done.result()
            ok, text = message.get("answer", (False, message.get("error", "")))
            outcome.set_result(Answer(ok, text))

        self._ask(verb, *words).add_done_callback(answered)
        return outcome

    def _ask(self, verb: str, *words: Any) -> Future[Message]:
        asked: Future[Message] = Future()
        with self._lock:
            refusal = CLOSED if self._closed else GONE if self._gone.is_set() else self._hangs
            number = next(self._numbers)
            if not refusal:
                self._asked[number] = asked
        if refusal:
            if refusal == GONE and self._owner:  # during start-up, nobody reads the answer yet when the host ends
                self._printed(Severity.ERROR, "launch", GONE)
            asked.set_result({"error": refusal})
        else:
            self._channel.send({"id": number, "do": verb, "with": list(words)})
        return asked

    def _received(self, message: Message) -> None:
        if "info" in message:
            self._info = info_from_data(message["info"], self._info, MAX_EVENTS)
        elif "record" in message:
            stamp, severity, name, text, site = message["record"]
            self._record(stamp, severity, name, text, (site[0], site[1], site[2]))
        elif "fact" in message:
            self._learn(*message["fact"])
        elif "dropped" in message:
            self._printed(
                Severity.WARN, "launch", f"{message['dropped']} lines were dropped because they came too fast"
            )
        else:
            with self._lock:
                asked = self._asked.pop(message.get("id", 0), None)
            if asked is not None:
                asked.set_result(message)

    def _lost(self) -> None:
        with self._lock:
            self._gone.set()
            left = list(self._asked.values())
            self._asked.clear()
            why = CLOSED if self._closed else GONE
        # A console's own host ends only at its request, and if it ended before it started anything, nothing else
        # reveals it.
        own = self._owner and not self._ends
        if why == GONE and (own or any(each.state not in ENDED for each in self._info.processes)):
            processes = tuple(map(_ended_with_host, self._info.processes))
            self._info = replace(self._info, processes=processes, problem=GONE)
            if own:
                self._printed(Severity.ERROR, "launch", GONE)
        for each in left:
            each.set_result({"error": why})


class HostedSnapshotBuffer:
    """The last minutes of the system's traffic, which the console's launch host keeps in memory."""

    def __init__(self, kept_s: float) -> None:
        self.kept_s = kept_s
        self.host: HostedLauncher | None = None

    def keep(self, folder: str) -> Future[Answer]:
        """Save the last minutes as a new bag."""
        if self.host is not None:
            return self.host.keep(folder)
        return done(Answer(False, "nothing has been started yet"))


def _ended_with_host(process: ProcessInfo) -> ProcessInfo:
    if process.state in ENDED:
        return process
    return replace(process, state=ProcessState.CRASHED, pid=None, cpu=None, memory=None, problem=GONE)
