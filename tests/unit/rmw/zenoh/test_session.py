"""Two sessions in one domain find each other, and their declarations work."""

import os
import threading

import pytest
from bot_console.runtime.rmw.zenoh.domain.mesh import open_session
from bot_console.runtime.rmw.zenoh.session import Session

TIMEOUT_S = 240.0


@pytest.fixture
def pair(socket_folder):
    one, two = open_session(0), open_session(0)
    linked = threading.Event()
    two.watch_links(lambda zid, on: linked.set())
    assert linked.wait(TIMEOUT_S)
    yield one, two
    one.close()
    two.close()


def ask(session: Session, key: str, payload: bytes) -> list[tuple[bytes, bytes | None]]:
    replies: list[tuple[bytes, bytes | None]] = []
    done = threading.Event()
    querier = session.declare_querier(key, TIMEOUT_S)
    querier.get(payload, b"ask", lambda *reply: replies.append(reply), done.set)
    assert done.wait(TIMEOUT_S)
    return replies


def tokens(session: Session, key: str) -> set[str]:
    found, answered = session.collect_tokens(key, TIMEOUT_S)
    assert answered
    return set(found)


def wait_for_token(one: Session, two: Session, key: str) -> threading.Event:
    """Wait until `two` has a token of `one`, and so all earlier ones; return an event set when the token leaves."""
    came, went = threading.Event(), threading.Event()
    two.watch_tokens(key, lambda _, there: (came if there else went).set())
    one.declare_token(key)
    assert came.wait(TIMEOUT_S)
    return went


def test_sessions_know_each_other(pair):
    one, two = pair
    assert (one.linked(), two.linked()) == ({two.zid}, {one.zid})


def test_late_subscriber_gets_cached_messages(pair):
    one, two = pair
    publisher = one.declare_publisher("t", cache=2)
    for payload in (b"1", b"2", b"3"):
        publisher.put(payload, b"a")
    got: list[tuple[bytes, bytes | None]] = []
    newest = threading.Event()

    def received(payload: bytes, attachment: bytes | None) -> None:
        got.append((payload, attachment))
        if payload == b"3":
            newest.set()

    two.declare_subscriber("t", received, history=2)
    assert newest.wait(TIMEOUT_S)
    assert got[-2:] == [(b"2", b"a"), (b"3", b"a")]


def test_query_is_answered_until_undeclared(pair):
    one, two = pair
    queryable = one.declare_queryable("s", lambda query: query.answer(query.payload * 2, b"answer"))
    wait_for_token(one, two, "s/1")
    assert ask(two, "s", b"x") == [(b"xx", b"answer")]
    queryable.undeclare()
    queryable.undeclare()
    wait_for_token(one, two, "s/2")
    assert ask(two, "s", b"x") == []


def test_tokens_are_seen_until_their_session_ends(pair):
    one, two = pair
    went = wait_for_token(one, two, "k/1")
    assert tokens(two, "k/**") == {"k/1"}
    one.close()
    assert went.wait(TIMEOUT_S)


def test_closing_session_removes_its_socket(pair, socket_folder):
    one, two = pair
    assert len(os.listdir(os.path.join(socket_folder, "0"))) == 4
    one.close()
    two.close()
    two.close()
    assert os.listdir(os.path.join(socket_folder, "0")) == []


def test_session_reopens_although_zenoh_closes_too_slowly(pair) -> None:
    one, two = pair
    old = one._zenoh

    class Slow:
        def close(self) -> None:
            old.close()
            raise one.errors()("close operation timed out!")

    one._zenoh = Slow()
    one.rejoin(lambda folder: True)
    linked = threading.Event()
    one.watch_links(lambda zid, on: linked.set())
    assert linked.wait(TIMEOUT_S) and one.linked() == {two.zid}


def test_tokens_of_others_are_collected(pair):
    one, two = pair
    wait_for_token(one, two, "token/1")
    assert two.collect_tokens("token/*", TIMEOUT_S) == (["token/1"], True)
    two.close()
    assert two.collect_tokens("token/*", TIMEOUT_S) == ([], False)
