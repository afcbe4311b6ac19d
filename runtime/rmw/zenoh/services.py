"""Requests and responses between processes."""

from __future__ import annotations

import threading
from collections import Counter, deque
from collections.abc import Callable
from typing import Any

from bot_console.runtime.process import current
from bot_console.runtime.process.notices import notify
from bot_console.runtime.rmw.endpoints import ClientEndpoint, NodeId, ServiceEndpoint
from bot_console.runtime.rmw.zenoh.declarations import Declaration, Querier, Query
from bot_console.runtime.rmw.zenoh.session import Session
from bot_console.runtime.rmw.zenoh.wire.attachment import key_hash_of, pack, unpack
from bot_console.runtime.rmw.zenoh.wire.keys import FormatError
from bot_console.runtime.rmw.zenoh.wire.tokens import Token
from bot_console.runtime.rosidl.cdr import CdrError, deserialize, serialize

ANSWER_TIMEOUT_S = 600.0
"""Timeout of a request, in s; the same as in rmw_zenoh."""
RESULT_TIMEOUT_S = 30 * 86400.0
"""Timeout of an action's result request, in s; it is answered when the goal has ended."""
RESULT = "/_action/get_result"
MAX_PENDING = 1000
"""How many unanswered requests a server keeps; beyond that, the oldest are dropped."""

Caller = tuple[bytes, int]
"""Identifies a request: the client's id and the client's sequence number."""


class RemoteClient(ClientEndpoint):
    """A client in another process, as it appears in the server's request queue."""

    served: RequestReceiver


class RequestReceiver:
    """Queues the requests of other processes for a server, and sends the responses back."""

    def __init__(self, session: Session, service: ServiceEndpoint, key: str) -> None:
        self._service = service
        self._key_hash = key_hash_of(key)
        self._lock = threading.Lock()
        self._pending: dict[Caller, Query] = {}
        self._process = current()
        self._clock = current().clock
        self._declared: Declaration = session.declare_queryable(key, self.on_query)

    def on_query(self, query: Query) -> None:
        """Handle a request, on one of Zenoh's threads."""
        service = self._service
        try:
            number, _, gid = unpack(query.attachment, query.payload, self._key_hash)
            if number < 0 or not query.payload:
                raise FormatError("its number is negative, or it is empty")
            request = deserialize(query.payload, service.service_class.Request)
        except (FormatError, CdrError) as error:
            notify(self._process, f"a request to '{service.name}' was dropped: {error}")
            query.drop()
            return
        with self._lock:
            if (gid, number) in self._pending:
                query.drop()
                return
            self._pending[gid, number] = query
            oldest = self._pending.pop(next(iter(self._pending))) if len(self._pending) > MAX_PENDING else None
        if oldest is not None:
            oldest.drop()
        client = RemoteClient(NOWHERE, service.name, service.type_name, _nothing, service.service_class, gid=gid)
        client.served = self
        service.queue.append((client, number, request))
        service.notify()

    def respond(self, client: RemoteClient, number: int, response: Any) -> None:
        """Send a response; does nothing if no request is waiting for it any more."""
        with self._lock:
            query = self._pending.pop((client.gid, number), None)
        if query is not None:
            payload = serialize(response)
            query.answer(payload, pack(number, self._clock.system_ns(), client.gid, payload, self._key_hash))

    def close(self) -> None:
        """Stop serving and drop pending requests."""
        self._declared.undeclare()
        with self._lock:
            pending, self._pending = self._pending, {}
        for query in pending.values():
            query.drop()


class RequestSender:
    """Sends a client's requests to servers in other processes, and queues their responses for it."""

    def __init__(self, session: Session, client: ClientEndpoint, key: str) -> None:
        self._session = session
        self._client = client
        self._key = key
        self._key_hash = key_hash_of(key)
        self._process = current()
        self._clock = current().clock
        self._querier: Querier | None = None
        self._held_back: deque[tuple[int, Any]] = deque(maxlen=MAX_PENDING)
        self._servers: Counter[str] = Counter()
        """The number of servers in each session that has one."""

    @property
    def has_server(self) -> bool:
        """Whether another process has a server of this service."""
        return bool(self._servers)

    def watch_servers(self) -> Callable[[], bool]:
        """Return a function that tells whether all servers there are now are known to have ended."""
        sessions = {zid: self._session.pid_of(zid) for zid in tuple(self._servers)}

        def ended() -> bool:
            return bool(sessions) and all(
                zid not in self._servers and self._session.is_really_gone(zid, pid) for zid, pid in sessions.items()
            )

        return ended

    def on_token(self, token: Token, came: bool) -> None:
        """Handle a server of another process that appeared or disappeared."""
        if token.type_name == self._client.type_name and self._key.endswith("/" + token.type_hash):
            servers = Counter(self._servers)
            servers[token.node.zid] += 1 if came else -1
            self._servers = +servers  # replaced as a whole, as other threads read it

    def request(self, number: int, request: Any) -> None:
        """Send a request to the servers in other processes, if any; held back while the session is reopening."""
        if not self._ask(number, request):
            self._held_back.append((number, request))
            if self._session.settled.is_set():  # the session has just been reopened
                self.send_again()

    def _ask(self, number: int, request: Any) -> bool:
        """Send a request; return False if the session is closed or being reopened."""
        if self._querier is None:
            timeout = RESULT_TIMEOUT_S if self._client.name.endswith(RESULT) else ANSWER_TIMEOUT_S
            self._querier = self._session.declare_querier(self._key, timeout)
        payload = serialize(request)
        attachment = pack(number, self._clock.system_ns(), self._client.gid, payload, self._key_hash)
        return self._querier.get(payload, attachment, self._on_reply)

    def send_again(self) -> None:
        """Send the requests held back while the session was being reopened."""
        for _ in range(len(self._held_back)):
            try:
                waiting = self._held_back.popleft()
            except IndexError:  # another thread is doing the same
                return
            if not self._ask(*waiting):
                self._held_back.appendleft(waiting)
                return

    def _on_reply(self, payload: bytes, attachment: bytes | None) -> None:
        """Handle a response, on one of Zenoh's threads."""
        client = self._client
        try:
            number, _, gid = unpack(attachment, payload, self._key_hash)
            if gid != client.gid:
                return
            response = deserialize(payload, client.service_class.Response)
        except (FormatError, CdrError) as error:
            notify(self._process, f"a response of '{client.name}' was dropped: {error}")
            return
        client.queue.append((number, response))
        client.notify()

    def close(self) -> None:
        """Undeclare the querier."""
        if self._querier is not None:
            self._querier.undeclare()


NOWHERE = NodeId("", "/")
"""The node of every remote client; it is never looked up."""


def _nothing() -> None:
    """Notify nobody."""
