"""Without Unix sockets, programs use ports of 127.0.0.1, and only programs that can read a secret get a link."""

from __future__ import annotations

import json
import os
import socket
import stat
import sys
from collections.abc import Iterator
from typing import Any

import pytest
import zenoh
from bot_console.runtime.rmw.zenoh.domain import loopback, sockets
from bot_console.runtime.rmw.zenoh.domain.mesh import MeshSession, open_session
from bot_console.runtime.rmw.zenoh.session import SessionError
from bot_console.runtime.rmw.zenoh.settings import Serving
from helpers.processes.mesh import eventually, every_pair_talks, members


@pytest.fixture(autouse=True)
def on_ports(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("BOT_CONSOLE_LOOPBACK", "1")


@pytest.fixture
def session(socket_folder: str) -> Iterator[MeshSession]:
    opened = open_session(0)
    yield opened
    opened.close()


def names(folder: str) -> set[str]:
    return {name for name in os.listdir(f"{folder}/0") if name.endswith(".tcp")}


def gets_link(settings: dict[str, Any]) -> bool:
    """Return whether a program with these link settings, besides the defaults, gets a link; waits for it."""
    config = zenoh.Config.from_json5(json.dumps({"mode": "client", "scouting": {"multicast": {"enabled": False}}}))
    for path, value in settings.items():
        config.insert_json5(path, json.dumps(value))
    try:
        with zenoh.open(config) as opened:
            return bool([*opened.info.peers_zid(), *opened.info.routers_zid()])
    except zenoh.ZError:
        return False


def test_simultaneously_started_processes_find_each_other_and_a_killed_one_is_cleaned_up(socket_folder: str) -> None:
    with members(3) as (one, two, killed):
        assert every_pair_talks([one, two, killed])
        killed.end()
        assert eventually(lambda: one.ask("linked") == {two.zid})
        with members(1) as [late]:
            assert every_pair_talks([one, two, late])
            assert len(names(socket_folder)) == 3


def test_process_whose_files_were_deleted_is_found_again(socket_folder: str) -> None:
    with members(2) as (one, two):
        assert every_pair_talks([one, two])
        for name in os.listdir(f"{socket_folder}/0"):
            os.unlink(f"{socket_folder}/0/{name}")
        assert eventually(lambda: len(names(socket_folder)) == 2)
        with members(1) as [late]:
            assert every_pair_talks([one, two, late])


def test_only_loopback_is_listened_on(session: MeshSession) -> None:
    assert session.socket.endpoint().startswith("tcp/127.0.0.1:")
    port = int(session.socket.endpoint().rpartition(":")[2])
    with socket.create_connection(("127.0.0.1", port), 5.0):
        pass
    with pytest.raises(OSError), socket.create_connection(("127.0.0.2", port), 5.0):
        pass


def test_program_without_the_secret_gets_no_link(session: MeshSession, socket_folder: str) -> None:
    place = {"connect/endpoints": [session.socket.endpoint()], "connect/timeout_ms": 2000}
    known = loopback.authentication(f"{socket_folder}/0")["usrpwd"]
    assert gets_link({**place, "transport/auth/usrpwd": {**known}})
    assert not gets_link(place)
    assert not gets_link({**place, "transport/auth/usrpwd": {**known, "password": "guessed"}})


def test_secret_is_private_and_stable(session: MeshSession, socket_folder: str) -> None:
    path = f"{socket_folder}/0/{loopback.SECRET}"
    assert stat.S_IMODE(os.stat(path).st_mode) == 0o600
    assert loopback.authentication(f"{socket_folder}/0") == loopback.authentication(f"{socket_folder}/0")


def test_another_port_is_tried_if_the_chosen_one_is_taken(socket_folder: str, monkeypatch: pytest.MonkeyPatch) -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        ports = iter([taken.getsockname()[1], loopback._free_port()])
        monkeypatch.setattr(loopback, "_free_port", lambda: next(ports))
        session = open_session(0)
    session.close()
    assert not names(socket_folder)


def test_port_file_not_yet_written_is_ignored(session: MeshSession, socket_folder: str) -> None:
    half = loopback.OpenPort(f"{socket_folder}/0/{os.getpid()}.0badc0de.tcp")
    with open(f"{socket_folder}/0/{os.getpid()}.0badc0de.tcp", "w"):
        pass
    late = open_session(0)
    assert eventually(lambda: session.zid in late.linked())
    late.close()
    half.close()


def test_processes_on_sockets_and_on_ports_do_not_see_each_other(
    session: MeshSession, socket_folder: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert [each.pid for each in sockets.sockets(f"{socket_folder}/0")] == [os.getpid()]
    monkeypatch.delenv("BOT_CONSOLE_LOOPBACK")
    assert sockets.sockets(f"{socket_folder}/0") == []


def test_other_machines_are_refused(socket_folder: str) -> None:
    with pytest.raises(SessionError, match="BOT_CONSOLE_LOOPBACK"):
        MeshSession(0, Serving(("tcp/127.0.0.1:0",)))


def test_loopback_is_chosen_without_unix_sockets(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("BOT_CONSOLE_LOOPBACK")
    assert not loopback.is_chosen()
    monkeypatch.setattr(sys, "platform", "win32")
    assert loopback.is_chosen()
