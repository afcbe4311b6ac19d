"""The cache of the graph processes each token once, whether it is reported once or twice."""

from __future__ import annotations

from collections.abc import Callable

from bot_console.runtime.rmw.zenoh import graph_cache as watching
from bot_console.runtime.rmw.zenoh.graph_cache import GraphCache
from bot_console.runtime.rmw.zenoh.wire.tokens import TokenNode, node_token

KEY = node_token(0, TokenNode("ab", 1, "/", "/", "talker"))


class FakeSession:
    """A session whose tokens are reported by the test."""

    zid = "cd"

    def watch_tokens(self, key: str, seen: Callable[[str, bool], None], *, apart: bool = False) -> None:
        self.report = seen


def test_token_reported_twice_is_parsed_and_passed_on_once(monkeypatch):
    read: list[str] = []
    parse = watching.parse_token
    monkeypatch.setattr(watching, "parse_token", lambda key: (read.append(key), parse(key))[1])
    session, heard = FakeSession(), []
    seen = GraphCache(session, "**")  # type: ignore[arg-type]  # the part of a session that it uses
    seen.listen(lambda token, came: heard.append((token.key, came)))
    for came in (True, True, False, True):
        session.report(KEY, came)
    assert read == [KEY] * 3
    assert heard == [(KEY, True), (KEY, False), (KEY, True)]
