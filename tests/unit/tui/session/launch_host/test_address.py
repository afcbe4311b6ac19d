"""The socket through which further consoles connect to a launch host."""

from __future__ import annotations

import os
import queue
import socket
import subprocess
import sys
from pathlib import Path

from bot_console.runtime.rmw.zenoh.domain.sockets import process_exists
from bot_console.tui.session.launch_host.address import (
    HostListener,
    connect_to_host,
    host_addresses,
    remove_addresses_of_dead_hosts,
)


def test_connections_are_accepted_until_the_listener_is_closed(tmp_path: Path) -> None:
    entered: queue.Queue[socket.socket] = queue.Queue()
    gate = HostListener(str(tmp_path), entered.put)
    (tmp_path / "4711.0a1b2c3d").write_text("another file of the folder")
    assert host_addresses(str(tmp_path)) == [gate.path]
    outside = connect_to_host(gate.path)
    assert outside is not None
    inside = entered.get(timeout=240)
    outside.sendall(b"hello")
    assert inside.recv(5) == b"hello"
    gate.close()
    assert host_addresses(str(tmp_path)) == [] and connect_to_host(gate.path) is None
    for each in (outside, inside):
        each.close()


def test_the_address_of_a_dead_host_is_removed_and_a_new_one_takes_its_place(tmp_path: Path) -> None:
    dead = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    dead.bind(str(tmp_path / "99.host"))
    dead.close()
    assert connect_to_host(str(tmp_path / "99.host")) is None
    assert host_addresses(str(tmp_path)) == []
    first = HostListener(str(tmp_path), lambda connection: None)
    second = HostListener(str(tmp_path), lambda connection: None)  # of another process that has got the same id
    connection = connect_to_host(second.path)
    assert connection is not None
    connection.close()
    second.close()
    first.close()


def test_the_addresses_of_processes_that_have_ended_are_removed(tmp_path: Path) -> None:
    ended = subprocess.Popen([sys.executable, "-c", "pass"], stdout=subprocess.PIPE)
    assert ended.stdout is not None and ended.stdout.read() == b""
    os.waitid(os.P_PID, ended.pid, os.WEXITED | os.WNOWAIT)  # it stays a zombie: its parent has not waited for it
    for pid in (ended.pid, os.getppid()):
        (tmp_path / f"{pid}.host").touch()
    remove_addresses_of_dead_hosts(str(tmp_path), process_exists)
    assert host_addresses(str(tmp_path)) == [str(tmp_path / f"{os.getppid()}.host")]
    ended.communicate()
