"""What is looked at of the graph: each token is taken once, whether it is told once or twice."""

from __future__ import annotations

from collections.abc import Callable

from bot_console.runtime.rmw.zenoh import seen as looking
from bot_console.runtime.rmw.zenoh.seen import SeenTokens
from bot_console.runtime.rmw.zenoh.wire.tokens import TokenNode, node_token

KEY = node_token(0, TokenNode("ab", 1, "/", "/", "talker"))


class FakeSession:
    """A session whose tokens the test tells."""

    zid = "cd"

    def watch_tokens(self, key: str, seen: Callable[[str, bool], None], *, apart: bool = False) -> None:
        self.tell = seen


def test_a_token_that_is_told_twice_is_read_and_handed_on_once(monkeypatch):
    read: list[str] = []
    parse = looking.parse_token
    monkeypatch.setattr(looking, "parse_token", lambda key: (read.append(key), parse(key))[1])
    session, heard = FakeSession(), []
    seen = SeenTokens(session, "**")  # type: ignore[arg-type]  # the part of a session that it uses
    seen.listen(lambda token, came: heard.append((token.key, came)))
    for came in (True, True, False, True):
        session.tell(KEY, came)
    assert read == [KEY] * 3
    assert heard == [(KEY, True), (KEY, False), (KEY, True)]
