"""Serves a launcher to consoles: accepts their requests, and sends them its state and the output of processes."""

from __future__ import annotations

import socket
import threading
import time
from collections import deque
from collections.abc import Callable, Mapping
from concurrent.futures import Future
from functools import partial
from typing import Any

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.bags.port import SnapshotKeeper
from bot_console.tui.console.launch.process_output import Add
from bot_console.tui.console.model import LaunchInfo
from bot_console.tui.session.launch_host.channel import Channel, Message
from bot_console.tui.session.launch_host.plain_data import arguments_to_data, info_to_data
from bot_console.tui.session.protocol import ClosableLauncher

LAUNCHER_POLL_S = 0.1
"""Seconds between two checks for changes while a console is connected."""
UNSEEN_POLL_S = 0.5
"""The same while none is connected, when only failed processes are restarted and output is settled."""
MAX_LINES = 1000
"""The number of past lines of output that are sent to a console which connects later."""
MAX_FACTS = 10_000
"""The number of past facts, one per declared parameter, that are sent to such a console."""

VERBS = ("launch", "start", "stop", "kill", "restart", "restart_on_failure", "leave_ended")

Printed = Callable[[int, str, str], None]


class _Console:
    """One connected console."""

    def __init__(self, owner: bool) -> None:
        self.owner = owner
        self.channel: Channel
        self.known: LaunchInfo | None = None
        self.next_event = 0


class LaunchHost:
    """A launcher, and the consoles that control it. Methods may be called from any thread."""

    def __init__(
        self,
        make: Callable[[Add, Printed], ClosableLauncher],
        also: Printed | None = None,
        buffer: SnapshotKeeper | None = None,
    ) -> None:
        """`make` receives the functions for log records and for printed lines; `also` receives printed lines as well.

        `buffer` keeps the last minutes of this process's traffic; None: they are not kept.
        """
        self._also = also
        self._buffer = buffer
        self._lock = threading.RLock()
        self._consoles: list[_Console] = []
        self._lines: deque[Message] = deque(maxlen=MAX_LINES)
        self._facts: deque[Message] = deque(maxlen=MAX_FACTS)
        self.over = threading.Event()
        """Set when everything has ended, at a console's request or because the console that owns this host has gone."""
        self._replies: deque[tuple[_Console, Message]] = deque()
        self._wake = threading.Event()
        self._ended = False
        self._service = make(self._record, self.printed)
        threading.Thread(target=self._poll, name="launcher state", daemon=True).start()

    def connect(self, connection: socket.socket, *, owner: bool = False) -> None:
        """Serve another console; when an owner disconnects, everything ends."""
        console = _Console(owner)
        console.channel = Channel(connection, partial(self._received, console), partial(self._lost, console))
        with self._lock:
            for each in (*self._facts, *self._lines):
                console.channel.send(each, spare=True)
            self._consoles.append(console)
        console.channel.start()
        self._wake.set()

    def _record(self, stamp: int, severity: int, name: str, text: str, site: tuple[str, str, int]) -> None:
        self._line(_record_message(stamp, severity, name, text, site))

    def printed(self, severity: int, name: str, text: str) -> None:
        """Send a printed line to all consoles."""
        self._also_notified(severity, name, text)
        self._line(_record_message(time.time_ns(), severity, name, text))

    def learn(self, kind: str, facts: Mapping[str, Any]) -> None:
        """Send a fact about a program or a launch to all consoles."""
        self._pass_on({"fact": [kind, dict(facts)]}, self._facts, spare=False)

    def noticed(self, severity: int, name: str, text: str) -> None:
        """Send a notice about a process to all consoles; unlike a line, it is not displaced by a flood of output."""
        self._also_notified(severity, name, text)
        self._pass_on(_record_message(time.time_ns(), severity, name, text), self._facts, spare=False)

    def _also_notified(self, severity: int, name: str, text: str) -> None:
        if self._also is not None:
            self._also(severity, name, text)

    def _line(self, message: Message) -> None:
        self._pass_on(message, self._lines, spare=True)

    def _pass_on(self, message: Message, kept: deque[Message], *, spare: bool) -> None:
        with self._lock:
            kept.append(message)
            for each in self._consoles:
                each.channel.send(message, spare=spare)

    def _poll(self) -> None:
        """Send changes to the consoles; a lock keeps an older state from following a newer one."""
        while not self.over.is_set():
            self._wake.wait(LAUNCHER_POLL_S if self._consoles else UNSEEN_POLL_S)
            self._wake.clear()
            ended = self._ended
            replies = [self._replies.popleft() for _ in range(len(self._replies))]
            # newer than the replies, so that a console with a reply also has the state that it refers to
            info = self._service.info()
            with self._lock:
                for each in self._consoles:
                    self._report(each, info)
            for console, message in replies:
                console.channel.send(message)
            if ended:
                self.over.set()

    def _report(self, console: _Console, info: LaunchInfo) -> None:
        if info is not console.known:
            console.channel.send({"info": info_to_data(info, console.next_event)})
            console.known = info
            console.next_event = info.timeline[-1].seq + 1 if info.timeline else 0

    def _received(self, console: _Console, message: Message) -> None:
        number, verb, words = message.get("id"), message.get("do"), message.get("with", [])
        reply = partial(self._reply, console, number)
        if verb in VERBS or (verb == "keep" and self._buffer is not None):
            outcome: Future[Answer] = getattr(self._buffer if verb == "keep" else self._service, verb)(*words)
            outcome.add_done_callback(lambda done: reply(answer=[done.result().ok, done.result().text]))
        elif verb == "arguments":
            threading.Thread(target=self._arguments, args=(reply, *words), daemon=True).start()
        elif verb == "files":
            reply(value=list(self._service.files()))
        elif verb == "close":
            threading.Thread(target=self._close, args=(reply,), daemon=True).start()
        else:
            reply(error=f"this launch host does not know '{verb}': it is of another version")

    def _reply(self, console: _Console, number: Any, **what: Any) -> None:
        self._replies.append((console, {"id": number, **what}))
        self._wake.set()

    def _arguments(self, reply: Callable[..., None], path: str) -> None:
        try:
            reply(value=arguments_to_data(self._service.arguments(path)))
        except ValueError as error:
            reply(error=str(error))

    def _close(self, reply: Callable[..., None] | None = None) -> None:
        self._service.close()
        if reply is not None:
            reply(value=True)
        self._ended = True
        self._wake.set()

    def _lost(self, console: _Console) -> None:
        with self._lock:
            self._consoles.remove(console)
        if console.owner and not self.over.is_set():
            self._close()

    def close(self) -> None:
        """End everything, then disconnect."""
        if not self.over.is_set():
            self._close()
            self.over.wait(1.0)
        with self._lock:
            consoles = list(self._consoles)
        for each in consoles:
            each.channel.close()


def _record_message(
    stamp: int, severity: int, name: str, text: str, site: tuple[str, str, int] = ("", "", 0)
) -> Message:
    """A line with the time (ns since the epoch) at which it arrived, for consoles that connect later too."""
    return {"record": [stamp, severity, name, text, list(site)]}
