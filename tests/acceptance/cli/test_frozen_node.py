"""A verb that queries a frozen process through a router ends, and names the process that does not answer."""

from __future__ import annotations

import os
import signal
from pathlib import Path

import pytest
from bot_console.runtime.rmw.zenoh.domain.mesh import MeshSession
from bot_console.runtime.rmw.zenoh.network.client import ClientConfig, open_network_session
from bot_console.runtime.rmw.zenoh.settings import Serving
from helpers.processes.mesh import eventually
from helpers.processes.two_processes import DOMAIN, two_processes
from processes.command_line import run_cli
from processes.ports import free_port

if os.name == "nt":
    pytest.skip("needs SIGSTOP", allow_module_level=True)

TIMEOUT_S = 240


@pytest.mark.parametrize(
    "words",
    [
        ("param", "get", "/other/peer", "speed"),
        pytest.param(("service", "call", "/pull", "std_srvs/srv/Trigger"), marks=pytest.mark.soak),
    ],
    ids=" ".join,
)
def test_request_to_a_frozen_process_ends_and_names_it(tmp_path: Path, words: tuple[str, ...]) -> None:
    with two_processes(tmp_path / "s") as (_, (peer,)):
        place = f"tcp/127.0.0.1:{free_port()}"
        router = MeshSession(DOMAIN, Serving((place,)))
        router.watch()
        client = open_network_session(DOMAIN, ClientConfig((place,)))
        client.watch()
        try:
            peer.send_signal(signal.SIGSTOP)
            assert eventually(lambda: list(client.stopped().values()) == [peer.pid])
            asked = run_cli(*words, env=dict(os.environ, BOT_CONSOLE_CONNECT=place))
        finally:
            client.close()
            router.close()
    assert asked.returncode == 1
    assert asked.stderr.splitlines()[-1] == f"/other/peer does not answer: its process {peer.pid} is stopped"
