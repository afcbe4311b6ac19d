"""A new watch of the graph sees everything at once, and nothing that has left."""

from __future__ import annotations

import os
from typing import Any, cast

import pytest
from bot_console.runtime.rmw.zenoh import graph_cache as watching
from bot_console.runtime.rmw.zenoh import whole_graph
from bot_console.runtime.rmw.zenoh.declarations import TokenWatch
from bot_console.runtime.rmw.zenoh.domain.mesh import MeshSession, open_session
from bot_console.runtime.rmw.zenoh.graph_cache import Watches
from bot_console.runtime.rmw.zenoh.graph_snapshot import watch_all
from bot_console.runtime.rmw.zenoh.network.client import ClientConfig, open_network_session
from bot_console.runtime.rmw.zenoh.session import ROLL_CALL_KEY
from bot_console.runtime.rmw.zenoh.settings import Serving
from bot_console.runtime.rmw.zenoh.whole_graph import WholeGraph
from bot_console.runtime.rmw.zenoh.wire.tokens import TokenNode, entity_token
from helpers.processes.mesh import eventually
from helpers.processes.ports import free_port

MANY, TOPICS = 400, 4
ROUNDS = 5
QOS = "::,10:,:,:,,"


def show(session: Any, count: int) -> list[Any]:
    node = TokenNode(session.zid, 0, "", "/", "talker")
    names = [
        entity_token(0, node, each, "MP", f"/topic_{each % TOPICS}", "a/msg/B", "RIHS01_0", QOS)
        for each in range(count)
    ]
    return [session.declare_token(each) for each in names]


def wait_patiently(session: MeshSession) -> MeshSession:
    """Let a session wait for answers however busy the machine is; return it."""
    session.timeout_s = 60.0
    return session


def publishers(graph: WholeGraph) -> int:
    return len(graph.tables.publishers.all())


@pytest.mark.parametrize(("known", "single"), [(False, 48), pytest.param(True, 48, marks=pytest.mark.slow), (True, 1)])
def test_snapshot_is_complete_at_once_and_leaves_with_its_process(socket_folder, monkeypatch, known, single):
    monkeypatch.setattr(watching, "SINGLE", single)
    holder = open_session(0)
    for _ in range(ROUNDS):
        shown = show(holder, MANY)
        watcher = wait_patiently(open_session(0))
        assert eventually(lambda watcher=watcher: watcher.linked() == {holder.zid})
        watches = Watches(watcher)
        if known:  # it was reported earlier, to watches of these topics
            for each in range(TOPICS):
                watches.listen("MP", f"/topic_{each}", lambda token, came: None)
        graph = WholeGraph(watcher, lambda owner: None, watches.known)
        assert publishers(graph) == MANY
        for each in shown[: MANY // 2]:
            each.undeclare()
        assert eventually(lambda graph=graph: publishers(graph) == MANY // 2)
        for each in shown[MANY // 2 :]:
            each.undeclare()
        assert eventually(lambda graph=graph: publishers(graph) == 0)
        watcher.close()
    holder.close()


def test_clients_behind_a_router_of_the_mesh_appear_and_leave(socket_folder):
    place = f"tcp/127.0.0.1:{free_port()}"
    router, client = MeshSession(0, Serving((place,))), open_network_session(0, ClientConfig((place,)))
    show(client, MANY)
    watcher = wait_patiently(open_session(0))
    assert eventually(lambda: router.zid in watcher.linked())
    assert not watcher.links_directly() and not router.links_directly() and not client.links_directly()
    graph = WholeGraph(watcher, lambda owner: None)
    assert publishers(graph) == MANY
    client.close()
    assert eventually(lambda: publishers(graph) == 0)
    watcher.close()
    router.close()


def test_process_that_does_not_answer_is_named(socket_folder, monkeypatch):
    notices: list[str] = []
    monkeypatch.setattr(whole_graph, "notify", lambda process, text: notices.append(text))
    watcher = open_session(0)
    watcher.timeout_s = 0.1
    watcher.joined = (watcher.socket._replace(zid="abcdef01"),)
    WholeGraph(watcher, lambda owner: None)
    assert notices == [f"process {os.getpid()} does not answer, so its nodes may be missing here"]
    watcher.close()


class Mesh:
    """A session of direct links whose answers and links are set by the test."""

    def __init__(self, *links: str, direct: bool = True, answers: bool = True) -> None:
        """`links`: the ids of the linked sessions."""
        self.links, self.direct, self.answers = set(links), direct, answers
        self.asked: list[str] = []
        self.meanwhile: Any = lambda: None

    def answer_timeout_s(self) -> float:
        return 0.0

    def links_directly(self) -> bool:
        return self.direct

    def linked(self) -> set[str]:
        return self.links

    def watch_tokens(self, key: str, seen: Any, *, apart: bool) -> TokenWatch:
        self.watch = TokenWatch(cast("Any", self), lambda session: None, seen)
        return self.watch

    def collect_tokens(self, key: str, timeout: float) -> tuple[list[str], bool]:
        self.asked.append(key)
        self.meanwhile()
        return ([ROLL_CALL_KEY + "a" * 8] if key.startswith(ROLL_CALL_KEY) else ["asked"]), self.answers


def tokens_taken_in(mesh: Mesh, known: list[str] | None) -> list[tuple[str, bool]]:
    seen: list[tuple[str, bool]] = []
    watch_all(cast("Any", mesh), "**", lambda key, came: seen.append((key, came)), lambda: known)
    return seen


A, B = "a" * 32, "b" * 32


def test_history_is_completed_by_other_watches_if_all_links_answered():
    mesh = Mesh(A)
    assert tokens_taken_in(mesh, ["known"]) == [("known", True)]
    assert mesh.asked == [ROLL_CALL_KEY + "*"]


@pytest.mark.parametrize("mesh", [Mesh(A, answers=False), Mesh(A, B), Mesh(A, direct=False)])
def test_whole_graph_is_requested_if_the_history_may_be_incomplete(mesh):
    assert tokens_taken_in(mesh, ["known"]) == [("asked", True)]


def test_whole_graph_is_requested_if_other_watches_have_ended():
    assert tokens_taken_in(Mesh(A), None) == [("asked", True)]


def test_token_that_leaves_during_the_request_does_not_return():
    mesh = Mesh(A)
    mesh.meanwhile = lambda: mesh.watch.on_token("known", False)
    assert tokens_taken_in(mesh, ["known"]) == [("known", False)]
    mesh = Mesh(A)
    mesh.meanwhile = lambda: [mesh.watch.on_token("known", came) for came in (False, True)]
    assert tokens_taken_in(mesh, ["known"])[-1] == ("known", True)


class ReportingSession:
    """A session that reports one token to its first watch."""

    zid, domain = "cd", 0

    def watch_tokens(self, key: str, seen: Any) -> Any:
        seen(entity_token(0, TokenNode("ab", 0, "", "/", "n"), 1, "MP", "/t", "a/msg/B", "RIHS01_0", QOS), True)
        return TokenWatch(cast("Any", self), lambda session: None, seen)

    def forget(self, thing: Any) -> None:
        """Do nothing: nothing is declared."""


def test_watches_know_what_they_saw_until_one_ends():
    watches, listener = Watches(cast("Any", ReportingSession())), lambda token, came: None
    assert watches.known() == []
    watches.listen("MP", "/t", listener)
    (key,) = watches.known() or [""]
    assert key.startswith("@ros2_lv/0/ab/0/1/MP/")
    watches.forget("MP", "/t", listener)
    assert watches.known() is None
