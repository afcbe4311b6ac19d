"""Real processes in one domain: every pair communicates, and no killed or frozen process blocks another."""

from __future__ import annotations

import contextlib
import os
import shutil
import signal
import time

import pytest
from bot_console.runtime.rmw.zenoh.domain.mesh import open_session
from bot_console.runtime.rmw.zenoh.domain.roll_call import await_answers
from helpers.processes.mesh import TIMEOUT_S, eventually, every_pair_talks, members


def sockets_of(folder: str) -> set[str]:
    return {name for name in os.listdir(os.path.join(folder, "0")) if name[0].isdigit() and not name.endswith(".lock")}


@pytest.mark.slow
def test_simultaneously_started_processes_all_find_each_other():
    with members(8) as present:
        assert every_pair_talks(present)


@pytest.mark.soak
@pytest.mark.timeout(600)
def test_fifty_simultaneously_started_processes_all_find_each_other_ten_times(monkeypatch, socket_folder):
    for round_number in range(10):
        monkeypatch.setenv("BOT_CONSOLE_SOCKET_DIR", f"{socket_folder}{round_number}")
        with members(50) as present:
            assert every_pair_talks(present)


def test_socket_of_a_killed_process_is_removed_by_the_next(socket_folder):
    with members(3) as (one, two, killed):
        assert every_pair_talks([one, two, killed])
        killed.end()
        assert eventually(lambda: one.ask("linked") == {two.zid})
        with members(1) as [late]:
            assert every_pair_talks([one, two, late])
            assert len(sockets_of(socket_folder)) == 3


def test_leaving_process_removes_dead_sockets(socket_folder):
    with members(2) as (leaving, killed):
        assert every_pair_talks([leaving, killed])
        killed.end()
        assert len(sockets_of(socket_folder)) == 2
        leaving.report("exit")
        assert leaving.read()
    assert sockets_of(socket_folder) == set()


def test_first_link_to_a_process_of_very_many_declarations_lasts(socket_folder):
    with members(1, "crowded"):
        for _ in range(5):
            newcomer, links = open_session(0), list[bool]()
            newcomer.watch_links(lambda zid, there, links=links: links.append(there))
            assert await_answers(newcomer, TIMEOUT_S) == []
            assert links == [True]
            newcomer.close()


@pytest.mark.slow
def test_folder_full_of_dead_sockets_is_cleaned(socket_folder):
    with members(6) as dead:
        for each in dead:
            each.end()
    assert len(sockets_of(socket_folder)) == 6
    with members(2) as present:
        assert every_pair_talks(present)
        assert len(sockets_of(socket_folder)) == 2


def test_processes_join_communicate_and_leave_beside_a_frozen_one(socket_folder):
    with members(2) as (frozen, one):
        assert every_pair_talks([frozen, one])
        frozen.signal(signal.SIGSTOP)
        began = time.monotonic()
        with members(1) as [late]:
            assert every_pair_talks([one, late])
            for each in (one, late):
                each.report("exit")
                assert float(each.read()) < 5.0  # the library's default: 10 s
        assert time.monotonic() - began < 30.0


def test_thawed_process_is_found_by_newcomers():
    with members(1) as [frozen]:
        frozen.signal(signal.SIGSTOP)
        with members(2) as late:
            assert every_pair_talks(late)
            frozen.signal(signal.SIGCONT)
            assert every_pair_talks([frozen, *late])


def test_process_whose_socket_was_deleted_is_found_again(socket_folder):
    with members(2) as (one, two):
        assert every_pair_talks([one, two])
        for name in os.listdir(os.path.join(socket_folder, "0")):
            os.unlink(os.path.join(socket_folder, "0", name))
        assert eventually(lambda: len(sockets_of(socket_folder)) == 2)
        with members(1) as [late]:
            assert every_pair_talks([one, two, late])


def test_session_whose_folder_was_deleted_knows_no_processes_until_it_is_found_again(socket_folder):
    session = open_session(0)
    try:
        shutil.rmtree(os.path.join(socket_folder, "0"))
        assert not session.processes() and not session.stopped() and not session.debugged()
        assert session.pid_of(session.zid) is None
        session.watch()
        assert eventually(lambda: session.pid_of(session.zid) == os.getpid())
    finally:
        session.close()


@pytest.mark.soak
@pytest.mark.timeout(300)
def test_links_abandoned_while_opening_are_repaired():
    with members(10, "hasty") as present:
        ids = {each.zid for each in present}
        assert eventually(lambda: all(each.ask("answer") >= ids - {each.zid} for each in present))
        assert every_pair_talks(present)


@pytest.mark.skipif(not os.path.exists("/proc/net/tcp"), reason="the system does not list its sockets in /proc")
def test_no_port_is_opened():
    with members(2) as present:
        assert every_pair_talks(present)
        for each in present:
            pid = each.process.pid
            assert local_sockets(pid, "unix")
            assert {kind: local_sockets(pid, kind) for kind in PORTS} == {kind: set() for kind in PORTS}


PORTS = ("tcp", "tcp6", "udp", "udp6", "udplite", "udplite6", "raw", "raw6", "packet", "icmp", "icmp6")


def local_sockets(pid: int, kind: str) -> set[str]:
    """Return the inodes of the sockets of this kind that a process has open."""
    open_ones: set[str] = set()
    for name in os.listdir(f"/proc/{pid}/fd"):
        with contextlib.suppress(FileNotFoundError):
            open_ones.add(os.readlink(f"/proc/{pid}/fd/{name}"))
    try:
        with open(f"/proc/{pid}/net/{kind}") as table:
            words = {word for line in table for word in line.split()}
    except FileNotFoundError:
        return set()
    inodes = {each.removeprefix("socket:[").removesuffix("]") for each in open_ones if each.startswith("socket:[")}
    return inodes & words
