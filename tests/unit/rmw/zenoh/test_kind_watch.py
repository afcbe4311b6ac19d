"""Many topics share one watch for their kind: each listener receives what a separate watch would report."""

from __future__ import annotations

from typing import Any, cast

import pytest
from bot_console.runtime.rmw.zenoh import graph_cache as watching
from bot_console.runtime.rmw.zenoh.declarations import TokenCallback, TokenWatch
from bot_console.runtime.rmw.zenoh.domain.mesh import open_session
from bot_console.runtime.rmw.zenoh.graph_cache import Watches
from bot_console.runtime.rmw.zenoh.kind_watch import KindWatch
from bot_console.runtime.rmw.zenoh.wire.tokens import (
    Token,
    TokenNode,
    all_tokens,
    entity_token,
    tokens_of,
    tokens_of_kind,
)
from helpers.processes.mesh import eventually

Heard = list[tuple[str, bool]]


def token(topic: str, number: int = 1, kind: Any = "MP") -> str:
    node = TokenNode("ab", 0, "", "/", "talker")
    return entity_token(0, node, number, kind, topic, "a/msg/B", "RIHS01_0", "::,10:,:,:,,")


class FakeSession:
    """A session whose tokens are reported by the test, to each watch by its key."""

    zid, domain = "cd", 0

    def __init__(self) -> None:
        self.watches: dict[str, TokenWatch] = {}

    def watch_tokens(self, key: str, seen: TokenCallback, *, apart: bool = False) -> TokenWatch:
        self.watches[key] = TokenWatch(cast("Any", self), lambda session: None, seen)
        return self.watches[key]

    def forget(self, thing: Any) -> None:
        self.watches = {key: each for key, each in self.watches.items() if each is not thing}


@pytest.fixture
def session() -> FakeSession:
    return FakeSession()


@pytest.fixture
def watch(session: FakeSession) -> KindWatch:
    return KindWatch(cast("Any", session), "MP")


@pytest.fixture
def report(session: FakeSession, watch: KindWatch) -> Any:
    return session.watches[tokens_of_kind(0, "MP")].on_token


def recorder(heard: Heard) -> TokenCallback:
    return lambda key, came: heard.append((key, came))


def test_listener_receives_existing_new_and_leaving_tokens_of_its_topic_only(watch, report):
    there, later, other = token("/a/b"), token("/a/b", 2), token("/a")
    report(there, True)
    report(other, True)
    heard: Heard = []
    watch.watch("/a/b", recorder(heard))
    report(later, True)
    report(other, False)
    report(there, False)
    assert heard == [(there, True), (later, True), (there, False)]
    assert watch.known() == [later]


def test_ended_listener_receives_nothing_and_new_one_receives_existing_tokens(watch, report):
    heard: Heard = []
    first = watch.watch("/t", recorder([]))
    report(token("/t"), True)
    again = watch.watch("/t", recorder(heard))
    first.undeclare()  # late: another listener has replaced it
    report(token("/t", 2), True)
    again.undeclare()
    report(token("/t"), False)
    assert heard == [(token("/t"), True), (token("/t", 2), True)]


def test_tokens_that_left_or_are_unwatched_are_not_kept(watch, report):
    watched = watch.watch("/watched", recorder([]))
    for came in (True, False):
        report(token("/t"), came)
        report(token("/watched"), came)
    report("@ros2_lv/0/ab/0/1/MP", True)  # not a token of the format
    assert list(watch._rows) == ["%watched"]
    watched.undeclare()
    assert not watch._rows


def test_few_topics_are_watched_individually_and_more_by_kind(session, monkeypatch):
    monkeypatch.setattr(watching, "SINGLE", 2)
    watches = Watches(cast("Any", session))
    heard: list[Token] = []

    def listener(token: Token, came: bool) -> None:
        heard.append(token)

    for each in range(4):
        watches.listen("MP", f"/t{each}", listener)
    watches.listen("SS", "/t0", listener)
    singly = [tokens_of(0, "MP", "/t0"), tokens_of(0, "MP", "/t1"), tokens_of(0, "SS", "/t0")]
    assert set(session.watches) == {*singly, tokens_of_kind(0, "MP")}
    session.watches[tokens_of_kind(0, "MP")].on_token(token("/t3"), True)
    session.watches[singly[0]].on_token(token("/t0"), True)
    assert [each.topic for each in heard] == ["/t3", "/t0"]
    assert sorted(watches.known() or []) == [token("/t0"), token("/t3")]
    watches.forget("MP", "/t3", listener)
    session.watches[tokens_of_kind(0, "MP")].on_token(token("/t3", 2), True)
    assert len(heard) == 2
    assert token("/t3", 2) in (watches.known() or [])  # its kind is still watched
    watches.forget("MP", "/t0", listener)
    assert watches.known() is None
    watches.listen("MP", "/t4", listener)
    assert tokens_of(0, "MP", "/t4") in session.watches  # there is capacity for one more


def test_all_listeners_in_a_mesh_receive_existing_new_and_leaving_tokens(socket_folder, monkeypatch):
    monkeypatch.setattr(watching, "SINGLE", 1)
    holder, watcher = open_session(0), open_session(0)
    topics = [f"/t{each}" for each in range(4)]
    names = {each: token(each).replace("/ab/", f"/{holder.zid}/") for each in topics}
    shown = [holder.declare_token(names[each]) for each in topics[:3]]
    assert eventually(lambda: watcher.linked() == {holder.zid})
    assert eventually(lambda: len(watcher.collect_tokens(all_tokens(0), 1.0)[0]) == 3)
    watches = Watches(watcher)
    there: set[str] = set()

    def listener(token: Token, came: bool) -> None:
        (there.add if came else there.discard)(token.topic)

    for each in topics:
        watches.listen("MP", each, listener)
    assert eventually(lambda: there == {*topics[:3]})
    shown.append(holder.declare_token(names["/t3"]))
    assert eventually(lambda: there == {*topics})
    shown[1].undeclare()
    assert eventually(lambda: there == {"/t0", "/t2", "/t3"})
    holder.close()
    assert eventually(lambda: not there)
    watcher.close()
