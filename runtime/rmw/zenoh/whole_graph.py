"""The whole graph of a domain, watched from the first query on."""

from __future__ import annotations

import threading
from collections.abc import Container, Mapping, Sequence
from functools import lru_cache

from bot_console.runtime.process import current
from bot_console.runtime.process.notices import notify
from bot_console.runtime.rmw.endpoints import ClientEndpoint, Endpoint, GraphChanged, NodeId, ServiceEndpoint
from bot_console.runtime.rmw.graph_tables import GraphTables
from bot_console.runtime.rmw.zenoh.domain.roll_call import await_answers
from bot_console.runtime.rmw.zenoh.graph_cache import GraphCache
from bot_console.runtime.rmw.zenoh.graph_snapshot import Known
from bot_console.runtime.rmw.zenoh.session import Session
from bot_console.runtime.rmw.zenoh.wire.attachment import gid_of
from bot_console.runtime.rmw.zenoh.wire.tokens import Kind, Token, TokenNode, all_tokens

Row = NodeId | Endpoint | ServiceEndpoint | ClientEndpoint


class WholeGraph:
    """The graph entries of other processes, in tables like those of this process."""

    def __init__(self, session: Session, changed: GraphChanged, known: Known = lambda: None) -> None:
        """`known` returns the tokens that other watches of the session have seen."""
        self._changed = changed
        self.tables = GraphTables(threading.RLock())
        self._rows: dict[str, Row] = {}  # by token key; tokens arrive one after the other
        self._nodes: dict[str, tuple[str, NodeId]] = {}
        self.silent = await_answers(session, session.timeout_s)
        """The sockets of the processes that did not answer in time: their entries may be missing."""
        for each in self.silent:
            if each.is_stopped():
                text = f"process {each.pid} is stopped, so its nodes are not seen: `kill -CONT {each.pid}`"
            else:
                text = f"process {each.pid} does not answer, so its nodes may be missing here"
            notify(current(), text)
        key = all_tokens(session.domain)
        self._process, self._has_refused = current(), False
        self._seen = GraphCache(session, key, known=known, refused=self._refused)
        self._seen.listen(self._on_token)
        for pid in session.stopped_behind_router():
            notify(
                current(), f"process {pid} of the robot is stopped, so its nodes are silent: `kill -CONT {pid}` there"
            )

    def _refused(self, key: str) -> None:
        """Report the first graph entry that is no valid token."""
        if not self._has_refused:
            self._has_refused = True
            text = f"the graph contains {key[:120]!r}, which is not in the format of rmw_zenoh and is ignored"
            notify(self._process, f"{text}: `bot-console doctor` counts and lists such tokens")

    def _on_token(self, token: Token, came: bool) -> None:
        row = self._rows.setdefault(token.key, _row(token)) if came else self._rows.pop(token.key, None)
        if isinstance(row, NodeId) and came:
            self._nodes[token.key] = token.node.zid[:8], row
        elif isinstance(row, NodeId):
            self._nodes.pop(token.key, None)
        if row is not None:
            self._enter(token.kind, row, came)
        self._changed((token.node.name, token.node.namespace))

    def nodes_of(self, sessions: Container[str]) -> Mapping[str, Sequence[str]]:
        """Return the nodes of the sessions, which are given by the first 8 digits of their ids."""
        found: dict[str, list[str]] = {}
        for session, row in list(self._nodes.values()):
            if session in sessions:
                found.setdefault(session, []).append(row.full_name)
        return found

    def _enter(self, kind: Kind, row: Row, came: bool) -> None:
        tables = self.tables
        if isinstance(row, NodeId):
            (tables.add_node if came else tables.remove_node)(row)
        elif isinstance(row, Endpoint):
            ends = tables.publishers if kind == "MP" else tables.subscriptions
            (ends.add if came else ends.remove)(row)
        elif isinstance(row, ServiceEndpoint):
            (tables.servers.add if came else tables.servers.remove)(row)
        else:
            (tables.clients.add if came else tables.clients.remove)(row)


def _row(token: Token) -> Row:
    node = _node(token.node)
    if token.kind == "NN":
        return node
    if token.kind == "SS":
        return ServiceEndpoint(node, token.topic, token.type_name, _nothing, type_hash=token.type_hash)
    gid = gid_of(token.key)
    if token.kind == "SC":
        return ClientEndpoint(node, token.topic, token.type_name, _nothing, gid=gid)
    return Endpoint(node, token.topic, token.type_name, token.qos, gid, type_hash=token.type_hash)


@lru_cache(1024)  # a node has dozens of entities
def _node(node: TokenNode) -> NodeId:
    """Return a node's id. The number, made from session and node, is negative: this process uses positive ones."""
    number = -1 - (hash(node.zid) << 32 | node.number)
    return NodeId(node.name, node.namespace, node.enclave, number)


def _nothing() -> None:
    """Notify nobody: entities of other processes have no reader here."""
