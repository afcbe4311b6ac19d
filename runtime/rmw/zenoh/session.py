"""A session: this process's participation in a domain. Only this file imports Zenoh, and only to open a session.

Callbacks run on Zenoh's own threads, immediately and one after the other: they may only append to a queue and wake a
thread. The process must not fork once a session has been opened.
"""

# The stubs of zenoh leave the types of callbacks and of much that they get open:
# pyright: reportUnknownMemberType=false, reportUnknownVariableType=false, reportUnknownArgumentType=false

from __future__ import annotations

import contextlib
import json
import os
import threading
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from bot_console.runtime.process.machine_limits import require_address_space, require_descriptors
from bot_console.runtime.rmw.qos_matching import DDS, QosRules
from bot_console.runtime.rmw.zenoh.channel_worker import MAX_WAITING_SAMPLES, drain_in_worker
from bot_console.runtime.rmw.zenoh.congestion_control import BLOCKING_PRIORITY, MESSAGE_PRIORITY, REQUEST_PRIORITY
from bot_console.runtime.rmw.zenoh.declarations import (
    Declaration,
    Publisher,
    Querier,
    Query,
    Received,
    TokenCallback,
    TokenWatch,
)
from bot_console.runtime.rmw.zenoh.domain.sockets import Socket, process_exists
from bot_console.runtime.rmw.zenoh.lifetime import Lifetime
from bot_console.runtime.rmw.zenoh.link_threads import LinkWaker, link_threads
from bot_console.runtime.rmw.zenoh.settings import leaf_settings
from bot_console.runtime.rmw.zenoh.thread_state_cache import cache_thread_state, here
from bot_console.runtime.rmw.zenoh.transient_local_publisher import TransientLocalPublisher

if TYPE_CHECKING:
    import zenoh

ROLL_CALL_KEY = "@bot_console/"
"""Prefix of the token that each session declares; the first 8 digits of its id follow."""
ADDRESS_SPACE_KIB = 100_000
"""The address space that Zenoh and its threads reserve (55,000 KiB), and as much again temporarily. Zenoh aborts the
process if it cannot get it.
"""
DESCRIPTORS = 8
"""The file descriptors that a session without links needs. Zenoh panics if it cannot get them."""


class SessionError(RuntimeError):
    """A session cannot be opened."""


class SettingsError(SessionError):
    """Zenoh rejects the settings of a session."""


def endpoints_of_file(file: str, last: Iterable[tuple[str, str]]) -> Sequence[str]:
    """Return the endpoints to which this configuration makes a client connect; `last` (path, JSON5) overrides it."""
    import zenoh

    config = zenoh.Config.from_file(file)
    for path, value in last:
        config.insert_json5(path, value)
    found: Any = json.loads(config.get_json("connect/endpoints"))
    return found.get("client", ()) if isinstance(found, dict) else found


class Session(Lifetime):
    """A session of one domain; subclasses define how it connects. Call it from any thread but Zenoh's own."""

    joined: tuple[Socket, ...] = ()
    """The sockets to which the session connected on joining: those of this machine's processes that existed then."""
    timeout_s = 3.0
    """Timeout for the answers of running processes, in s."""

    never_waits = False
    """Whether every sample is delivered at once, so that no publisher ever has to wait or drop one."""

    def __init__(self, domain: int) -> None:
        super().__init__()
        self.domain = domain
        self.zid = f"{int.from_bytes(os.urandom(16), 'big') | 1 << 127:032x}"
        """The session's id: 32 hexadecimal digits, the first not 0. It stays the same in the graph after a rejoin."""
        self.on_rejoin: Callable[[], None] = lambda: None
        """Called after the session was reopened, to publish again what is kept for late subscribers."""
        self._waker: LinkWaker | None = None
        self.lost = 0
        """Number of messages to this session's subscriptions that were lost, judging by their sequence numbers."""

    def _open(self, settings: Mapping[str, object], file: str = "", last: Iterable[tuple[str, str]] = ()) -> None:
        """Open with these settings, which override those of `file` if given; `last` (path, JSON5) overrides both.

        Raises `SettingsError`, `SessionError`, `MemoryError` if Zenoh would not fit into the address space, and
        `OSError` if it could not open the files that it needs.
        """
        require_address_space(ADDRESS_SPACE_KIB)
        require_descriptors(DESCRIPTORS)
        import zenoh

        try:
            config = zenoh.Config.from_file(file) if file else zenoh.Config.from_json5(json.dumps(settings))
            for path, value in (*(leaf_settings(settings) if file else ()), *last):
                config.insert_json5(path, value)
        except (zenoh.ZError, OSError) as error:
            if file and not os.path.isfile(file):
                raise SettingsError(f"there is no file {file}") from None
            raise SettingsError(f"Zenoh rejects {file or 'these settings'}: {_first_line(error)}") from None
        try:
            with link_threads():
                self._zenoh = zenoh.open(config)
        except zenoh.ZError as error:
            raise SessionError(_first_line(error)) from None
        if self._waker is None:
            self._waker = LinkWaker(self._wake)
            self.watch_links(self._waker.link_changed)

    def _wake(self) -> None:
        """Wake an idle one of the threads that make links, with the timeout of a query that is sent nowhere."""
        import zenoh

        with contextlib.suppress(zenoh.ZError):  # no session is open
            self._zenoh.get(
                f"{ROLL_CALL_KEY}nobody",
                zenoh.handlers.FifoChannel(1),
                allowed_destination=zenoh.Locality.SESSION_LOCAL,
                timeout=0.001,
            )

    def close(self) -> None:
        """Close the session and its declarations; does nothing if it is already closed."""
        self._stop_polling()
        super().close()

    @staticmethod
    def errors() -> type[Exception]:
        """Zenoh's error class; only asked for once an error was raised."""
        import zenoh

        return zenoh.ZError

    def qos_rules(self, zid: str) -> QosRules:
        """Return the QoS rules between this process and the session with that id."""
        return DDS

    def watch(self) -> None:
        """Watch the session's connection while it is open; not meant for short-lived programs."""

    def answer_timeout_s(self) -> float:
        """Return the timeout of a graph query, in s: short if a process is known not to answer."""
        return self.timeout_s

    def stopped(self) -> Mapping[str, int]:
        """Return the frozen processes of the mesh: the first 8 digits of their session ids, mapped to their pids."""
        return {}

    def processes(self) -> Mapping[str, int]:
        """Return the mesh's processes on this machine: the first 8 digits of their session ids, mapped to pids."""
        return {}

    def debugged(self) -> Mapping[str, str]:
        """Return the processes stopped in a debugger: the first 8 digits of their session ids, with the line."""
        return {}

    def stopped_behind_router(self) -> Sequence[int]:
        """Return the pids of frozen processes behind a router, as far as it reports them; empty without a router."""
        return ()

    def leave(self) -> None:
        """Remove the session's files, for a process that exits at once without waiting for `close`."""
        self._stop_polling()

    def _stop_polling(self) -> None:
        """End the session's threads, as one that the interpreter's exit ended inside Zenoh would abort the process."""
        if self._waker:
            self._waker.end()

    def declare_publisher(
        self, key: str, *, reliable: bool = True, cache: int = 0, blocking: bool = False
    ) -> Publisher:
        """Declare a publisher for other sessions; late subscribers get up to `cache` of its latest samples.

        A `blocking` publisher drops nothing and waits for a full link instead, up to `WAIT_BEFORE_CUT_US`: use it in a
        separate thread. It has a priority of its own, as publishers that drop would otherwise wait behind it.
        """
        import zenoh

        control = zenoh.CongestionControl
        quality: dict[str, Any] = {
            "reliability": zenoh.Reliability.RELIABLE if reliable else zenoh.Reliability.BEST_EFFORT,
            "congestion_control": control.BLOCK if blocking else control.DROP,
            "priority": getattr(zenoh.Priority, BLOCKING_PRIORITY if blocking else MESSAGE_PRIORITY),
            "allowed_destination": zenoh.Locality.REMOTE,
        }

        def declare(session: zenoh.Session) -> Any:
            if not cache:
                return session.declare_publisher(key, **quality)
            # The heartbeat overtakes samples that a blocking publisher still has to send: a subscriber would take these
            # for lost, and fetch the last samples from the cache before those in between have arrived.
            return TransientLocalPublisher(zenoh.ext, session, key, quality, cache, misses=reliable and not blocking)

        return self._declare(Publisher(self, declare))

    def declare_subscriber(
        self, key: str, received: Received, *, reliable: bool = True, history: int | None = None
    ) -> Declaration:
        """Declare a subscriber to other sessions; it requests up to `history` of the latest samples."""
        import zenoh

        def take(sample: zenoh.Sample) -> None:
            if not here.kept:
                cache_thread_state()
            received(sample.payload.to_bytes(), _bytes(sample.attachment))

        ext = zenoh.ext
        remote = zenoh.Locality.REMOTE

        def declare(session: zenoh.Session) -> Any:
            callback = zenoh.handlers.Callback(take, indirect=False)
            if history is None:
                return session.declare_subscriber(key, callback, allowed_origin=remote)
            return ext.declare_advanced_subscriber(
                *(session, key, callback),
                allowed_origin=remote,
                history=ext.HistoryConfig(detect_late_publishers=True, max_samples=history),
                recovery=ext.RecoveryConfig(periodic_queries=None, heartbeat=True) if reliable else None,
                subscriber_detection=True,
            )

        return self._declare(Declaration(self, declare))

    def declare_queryable(self, key: str, asked: Callable[[Query], None]) -> Declaration:
        """Declare a queryable that answers the requests of a key."""
        import zenoh

        def take(query: zenoh.Query) -> None:
            if not here.kept:
                cache_thread_state()
            asked(Query(query, key, _bytes(query.payload) or b"", _bytes(query.attachment), zenoh.ZError))

        return self._declare(
            Declaration(
                self,
                lambda session: session.declare_queryable(
                    key, zenoh.handlers.Callback(take, indirect=False), complete=True
                ),
            )
        )

    def declare_querier(self, key: str, timeout: float) -> Querier:
        """Declare a querier of a key's queryables in other sessions; each request ends after `timeout` (s).

        Requests, and with them their answers, overtake messages, which would otherwise leave no room for them on a
        narrow link.
        """
        import zenoh

        def ask(
            inner: zenoh.Querier, payload: bytes, attachment: bytes, replied: Received, done: Callable[[], None] | None
        ) -> None:
            def take(reply: zenoh.Reply) -> None:
                if not here.kept:
                    cache_thread_state()
                sample = reply.ok
                if sample is not None:
                    replied(sample.payload.to_bytes(), _bytes(sample.attachment))

            inner.get(zenoh.handlers.Callback(take, done, indirect=False), payload=payload, attachment=attachment)

        return self._declare(
            Querier(
                self,
                lambda session: session.declare_querier(
                    key,
                    target=zenoh.QueryTarget.ALL_COMPLETE,
                    consolidation=zenoh.ConsolidationMode.NONE,
                    congestion_control=zenoh.CongestionControl.DROP,
                    priority=getattr(zenoh.Priority, REQUEST_PRIORITY),
                    allowed_destination=zenoh.Locality.REMOTE,
                    timeout=timeout,
                ),
                ask,
            )
        )

    def declare_token(self, key: str) -> Declaration:
        """Declare a liveliness token, which exists until it is undeclared or this process ends."""
        return self._declare(Declaration(self, lambda session: session.liveliness().declare_token(key)))

    def watch_tokens(self, key: str, seen: TokenCallback, *, apart: bool = False) -> TokenWatch:
        """Call back for each token that exists, appears or disappears; `key` may have wildcards.

        If `apart`, a separate thread does so, a few tokens at a time: thousands of them would keep Zenoh's threads, and
        with them all traffic on the links, waiting for the GIL.
        """
        import zenoh

        came = zenoh.SampleKind.PUT

        def take(sample: zenoh.Sample) -> None:
            if not here.kept:
                cache_thread_state()
            watch.on_token(str(sample.key_expr), sample.kind == came)

        def declare(session: zenoh.Session) -> Any:
            tokens = session.liveliness()
            if not apart:
                callback = zenoh.handlers.Callback(take, indirect=False)
                return tokens.declare_subscriber(key, callback, history=True)
            shown = tokens.declare_subscriber(key, zenoh.handlers.FifoChannel(MAX_WAITING_SAMPLES), history=True)
            watch.taking = drain_in_worker(shown.handler, take, zenoh.ZError)
            return shown

        watch = TokenWatch(self, declare, seen)
        return self._declare(watch)

    def collect_tokens(self, key: str, timeout: float) -> tuple[list[str], bool]:
        """Return the tokens of the sessions that answer within `timeout` (s), and whether all have answered.

        On a busy machine it may take twice the timeout. Replies go to a channel instead of a callback: Zenoh delivers
        them while holding its session's lock, unlike with any other callback, and a callback would wait there for the
        GIL. A thread that waits for that lock while it holds the GIL would then deadlock with it
        (`TransientLocalPublisher`).
        """
        import zenoh

        found: list[str] = []
        answered = False
        with contextlib.suppress(zenoh.ZError):  # no more replies, or no session is open
            replies = self._zenoh.liveliness().get(
                key, zenoh.handlers.FifoChannel(MAX_WAITING_SAMPLES), timeout=timeout
            )
            answered = True
            until = time.monotonic() + 2 * timeout
            pause = threading.Event()
            while time.monotonic() < until:
                reply = replies.try_recv()
                if reply is None:
                    pause.wait(0.001)
                elif reply.ok is not None:
                    found.append(str(reply.ok.key_expr))
                else:
                    answered = False
            answered = False
        return found, answered

    def links_directly(self) -> bool:
        """Whether each process is linked directly, without a router that answers for others."""
        return False

    def linked(self) -> set[str]:
        """Return the ids of the sessions that this session is linked to; empty while it is not open."""
        with contextlib.suppress(self.errors()):
            return {str(each) for each in (*self._zenoh.info.peers_zid(), *self._zenoh.info.routers_zid())}
        return set()

    def pid_of(self, zid: str) -> int | None:
        """Return the pid of the process that has another session; None if it is unknown or on another machine."""
        return None

    def is_really_gone(self, zid: str, pid: int | None) -> bool:
        """Whether what another session has withdrawn is really gone, instead of its link being lost for a moment.

        `pid` is what `pid_of` returned before.
        """
        return zid in self.linked() or (pid is not None and not process_exists(pid))

    def watch_links(self, changed: Callable[[str, bool], None]) -> Declaration:
        """Call back with the id of each session that is or gets linked (True), or whose link is lost (False)."""
        import zenoh

        def take(event: zenoh.TransportEvent) -> None:
            changed(str(event.transport.zid), event.kind == zenoh.SampleKind.PUT)

        return self._declare(
            Declaration(
                self,
                lambda session: session.info.declare_transport_events_listener(
                    zenoh.handlers.Callback(take, indirect=False), history=True
                ),
            )
        )

    def answering_sessions(self, who: str = "*", timeout: float = 0.1) -> set[str]:
        """Return the first 8 digits of the ids of the sessions that answer within `timeout` (s)."""
        return {each.removeprefix(ROLL_CALL_KEY) for each in self.collect_tokens(ROLL_CALL_KEY + who, timeout)[0]}

    def ping(self, timeout: float) -> Callable[[], bool | None]:
        """Ping the other end; returns a function that tells whether it answered within `timeout` (s), None while it
        may.

        Raises `RuntimeError` while the session is being closed.
        """
        import zenoh

        late = time.monotonic() + timeout * 0.98
        try:
            replies = self._zenoh.liveliness().get(
                f"{ROLL_CALL_KEY}nobody/{self.zid}", zenoh.handlers.FifoChannel(MAX_WAITING_SAMPLES), timeout=timeout
            )
        except zenoh.ZError:  # no session is open
            return lambda: False

        def answered() -> bool | None:
            with contextlib.suppress(zenoh.ZError):  # the query has ended
                while replies.try_recv() is not None:
                    pass  # nobody has such a token, but Zenoh may report its timeout this way
                if time.monotonic() < late:
                    return None
            # An unanswered query ends only after the timeout, and without a link at once.
            return time.monotonic() < late and bool(self.linked())

        return answered

    def answers_ping(self, timeout: float) -> bool:
        """Whether the other end answers a ping within `timeout` (s)."""
        answer, pause = self.ping(timeout), threading.Event()
        while (answered := answer()) is None:
            pause.wait(0.001)
        return answered


def preload() -> None:
    """Import Zenoh without opening or starting anything, for a process that forks others."""
    import zenoh.ext  # noqa: F401  # pyright: ignore[reportUnusedImport]


def _bytes(data: Any) -> bytes | None:
    return None if data is None else data.to_bytes()


def _first_line(error: Exception) -> str:
    """Return Zenoh's message without the source location."""
    return str(error).splitlines()[0].partition(" at /")[0]
