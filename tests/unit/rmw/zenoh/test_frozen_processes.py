"""Clients of a mesh's router learn of a frozen process at once, while Zenoh still considers it alive."""

from __future__ import annotations

import os
import signal
from pathlib import Path
from typing import Any, cast

import pytest
from bot_console.runtime.process import on_notice
from bot_console.runtime.rmw.zenoh.domain.debugger_note import SUFFIX
from bot_console.runtime.rmw.zenoh.domain.mesh import MeshSession
from bot_console.runtime.rmw.zenoh.network.client import ClientConfig, open_network_session
from bot_console.runtime.rmw.zenoh.network.frozen_processes import DEBUGGED_TOKEN, TOKEN, StoppedBehindRouter
from bot_console.runtime.rmw.zenoh.settings import Serving
from bot_console.runtime.rmw.zenoh.whole_graph import WholeGraph
from helpers.processes.mesh import eventually, members
from helpers.processes.ports import free_port

if os.name == "nt":
    pytest.skip("needs SIGSTOP", allow_module_level=True)


def test_frozen_or_debugged_process_is_reported_until_it_continues():
    place = f"tcp/127.0.0.1:{free_port()}"
    with members(1, "unwatched") as [member]:
        router = MeshSession(0, Serving((place,)))
        router.watch()
        client = open_network_session(0, ClientConfig((place,)))
        note = Path(router.socket.path).with_name(f"{member.process.pid}{SUFFIX}")
        try:
            assert client.stopped() == {}
            client.watch()
            member.process.send_signal(signal.SIGSTOP)
            assert eventually(lambda: client.stopped() == {member.zid[:8]: member.process.pid})
            reported: list[str] = []
            forget = on_notice(lambda process, text: reported.append(text))
            WholeGraph(client, lambda node: None)  # as every verb requests it
            forget()
            assert [str(member.process.pid) in each and "is stopped" in each for each in reported] == [True]
            member.process.send_signal(signal.SIGCONT)
            assert eventually(lambda: client.stopped() == {})
            assert client.stopped_behind_router() == []
            for line in ("/a b/*.py:12, in tick", "", "/ä.py:3"):
                note.write_text(line, "utf-8")
                assert eventually(lambda line=line: client.debugged() == {member.zid[:8]: line})
            note.unlink()
            assert eventually(lambda: client.debugged() == {})
        finally:
            client.close()
            router.close()


class Tokens:
    """A session whose tokens come and go as the test says."""

    def __init__(self) -> None:
        self._watching: dict[str, Any] = {}

    def watch_tokens(self, key: str, seen: Any) -> None:
        self._watching[key.removesuffix("*/*")] = seen

    def seen(self, key: str, came: bool) -> None:
        next(seen for prefix, seen in self._watching.items() if key.startswith(prefix))(key, came)


def test_tokens_of_other_kinds_report_nothing():
    tokens = Tokens()
    behind = StoppedBehindRouter(cast("Any", tokens))
    for key in ("a/x", "a/-1", "a/", "", "a/²", "b/12"):
        tokens.seen(TOKEN + key, True)
    assert behind.now() == {"b": 12}
    tokens.seen(TOKEN + "never/1", False)
    tokens.seen(TOKEN + "b/12", False)
    assert behind.now() == {}
    for key in ("a/", "a/6162", "a/xa", "a/xzz", f"a/x{'61' * 1001}", "b/x6162", "c/xff"):
        tokens.seen(DEBUGGED_TOKEN + key, True)
    assert behind.debugged() == {"b": "ab", "c": "\ufffd"}


def test_next_line_in_a_debugger_may_come_before_the_last_one_goes():
    tokens = Tokens()
    behind = StoppedBehindRouter(cast("Any", tokens))
    for key, came in (("a/x61", True), ("a/x62", True), ("a/x61", False)):
        tokens.seen(DEBUGGED_TOKEN + key, came)
    assert behind.debugged() == {"a": "b"}
    tokens.seen(DEBUGGED_TOKEN + "a/x62", False)
    assert behind.debugged() == {}
