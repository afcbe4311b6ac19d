"""Clients of a mesh's router learn of a frozen process at once, while Zenoh still considers it alive."""

from __future__ import annotations

import os
import signal
from typing import Any, cast

import pytest
from bot_console.runtime.process import on_notice
from bot_console.runtime.rmw.zenoh.domain.mesh import MeshSession
from bot_console.runtime.rmw.zenoh.network.client import Way, open_network_session
from bot_console.runtime.rmw.zenoh.network.frozen_processes import TOKEN, StoppedBehind
from bot_console.runtime.rmw.zenoh.settings import Serving
from bot_console.runtime.rmw.zenoh.whole_graph import WholeGraph
from helpers.processes.mesh import eventually, members
from helpers.processes.ports import free_port

if os.name == "nt":
    pytest.skip("needs SIGSTOP", allow_module_level=True)


def test_frozen_process_is_reported_until_it_continues():
    place = f"tcp/127.0.0.1:{free_port()}"
    with members(1) as [member]:
        router = MeshSession(0, Serving((place,)))
        router.watch()
        client = open_network_session(0, Way((place,)))
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
            assert client.stopped_afar() == []
        finally:
            client.close()
            router.close()


def test_tokens_of_other_kinds_report_nothing():
    class Tokens:
        def watch_tokens(self, key: str, seen: Any) -> None:
            self.seen = seen

    tokens = Tokens()
    behind = StoppedBehind(cast("Any", tokens))
    for key in ("a/x", "a/-1", "a/", "", "a/²", "b/12"):
        tokens.seen(TOKEN + key, True)
    assert behind.now() == {"b": 12}
    tokens.seen(TOKEN + "never/1", False)
    tokens.seen(TOKEN + "b/12", False)
    assert behind.now() == {}
