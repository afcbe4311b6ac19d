"""The whole graph of a domain, watched from the first question about it on."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence

from bot_console.runtime.process import current
from bot_console.runtime.process.notices import notify
from bot_console.runtime.rmw.endpoints import ClientEndpoint, Endpoint, NodeId, ServiceEndpoint
from bot_console.runtime.rmw.zenoh.domain.attendance import await_answers
from bot_console.runtime.rmw.zenoh.seen import SeenTokens
from bot_console.runtime.rmw.zenoh.session import Session
from bot_console.runtime.rmw.zenoh.wire.attachment import gid_of
from bot_console.runtime.rmw.zenoh.wire.tokens import Kind, Token, TokenNode, all_tokens

Row = NodeId | Endpoint | ServiceEndpoint | ClientEndpoint


class WholeGraph:
    """What other processes have in the graph, as rows like those of this process."""

    def __init__(self, session: Session, changed: Callable[[], None]) -> None:
        self._changed = changed
        self._lock = threading.Lock()
        self._rows: dict[Kind, dict[str, Row]] = {"NN": {}, "MP": {}, "MS": {}, "SS": {}, "SC": {}}
        self.silent = await_answers(session, session.patience)
        """The sockets of the processes that did not answer in time: what they have may be missing."""
        for each in self.silent:
            if each.is_stopped():
                notify(current(), f"process {each.pid} is stopped, so its nodes are not seen: `kill -CONT {each.pid}`")
        key, answered = all_tokens(session.domain), threading.Event()
        self._seen = SeenTokens(session, key)
        self._seen.listen(self._saw)
        # Watching brings what is there some time; only a question says when all of it has come.
        session.ask_tokens(key, lambda found: self._seen.saw(found, True), answered.set, session.patience)
        answered.wait(2 * session.patience)

    def _saw(self, token: Token, came: bool) -> None:
        with self._lock:
            if came:
                self._rows[token.kind][token.key] = _row(token)
            else:
                self._rows[token.kind].pop(token.key, None)
        self._changed()

    def _all(self, kind: Kind) -> Sequence[Row]:
        with self._lock:
            return list(self._rows[kind].values())

    def nodes(self) -> list[NodeId]:
        """The nodes."""
        return [each for each in self._all("NN") if isinstance(each, NodeId)]

    def publishers(self) -> list[Endpoint]:
        """The publishers."""
        return [each for each in self._all("MP") if isinstance(each, Endpoint)]

    def subscriptions(self) -> list[Endpoint]:
        """The subscriptions."""
        return [each for each in self._all("MS") if isinstance(each, Endpoint)]

    def servers(self) -> list[ServiceEndpoint]:
        """The service servers."""
        return [each for each in self._all("SS") if isinstance(each, ServiceEndpoint)]

    def clients(self) -> list[ClientEndpoint]:
        """The service clients."""
        return [each for each in self._all("SC") if isinstance(each, ClientEndpoint)]


def _row(token: Token) -> Row:
    node = _node(token.node)
    if token.kind == "NN":
        return node
    if token.kind == "SS":
        return ServiceEndpoint(node, token.topic, token.type_name, _nothing)
    gid = gid_of(token.key)
    if token.kind == "SC":
        return ClientEndpoint(node, token.topic, token.type_name, _nothing, gid=gid)
    return Endpoint(node, token.topic, token.type_name, token.qos, gid, type_hash=token.type_hash)


def _node(node: TokenNode) -> NodeId:
    """Nodes of this process have small positive numbers; those of others one made of session and number."""
    number = -1 - (hash(node.zid) << 32 | node.number)
    return NodeId(node.name, node.namespace, node.enclave, number)


def _nothing() -> None:
    """What others have wakes nobody here."""
