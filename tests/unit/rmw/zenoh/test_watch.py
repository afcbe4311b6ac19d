"""When a session is reopened because of another one: if a link carries nothing, but not if the process is frozen or
slow."""

from __future__ import annotations

import fcntl
import os
from collections.abc import Callable, Iterator

import pytest
from bot_console.runtime.rmw.zenoh.domain import watch as watching
from bot_console.runtime.rmw.zenoh.domain.sockets import Socket
from bot_console.runtime.rmw.zenoh.domain.watch import LINK_TIMEOUT_S, MAX_REOPENS, Watch

OWN, OTHER, THIRD = "aaaaaaaa", "bbbbbbbb", "cccccccc"
LOWER = "99999999"


class FakeSession:
    """A session whose links and answers are set by the test."""

    def __init__(self, folder: str) -> None:
        self.zid = OWN + "0" * 24
        self.socket = Socket(os.path.join(folder, f"1.{OWN}"), 1, OWN)
        self.links: set[str] = set()
        self.answering: set[str] = set()
        self.asked: list[str] = []
        self.changed: Callable[[str, bool], None] = lambda zid, there: None

    def linked(self) -> set[str]:
        return {f"{each}{'1' * 24}" for each in self.links}

    def watch_links(self, changed: Callable[[str, bool], None]) -> object:
        self.changed = changed
        return self

    def answering_sessions(self, who: str, timeout: float) -> set[str]:
        self.asked.append(who)
        return self.answering & self.links

    def rejoin(self, needed: Callable[[str], bool]) -> None:
        raise AssertionError("the test asks what the watch wants")


class Bench:
    """A watch on a folder, and a clock."""

    def __init__(self, folder: str, monkeypatch: pytest.MonkeyPatch) -> None:
        self.folder, self.now, self.stopped, self._locks = folder, 0.0, set[int](), dict[str, int]()
        monkeypatch.setattr(watching, "is_stopped", lambda pid: pid in self.stopped)
        monkeypatch.setattr(watching, "slowness", lambda: self.slowness)
        self.slowness = 1.0
        self.session = FakeSession(folder)
        self.appear(1, OWN)
        self.watch = Watch(self.session, lambda: self.now)

    def appear(self, pid: int, zid: str) -> None:
        """Add a living process, which holds its lock."""
        path = os.path.join(self.folder, f"{pid}.{zid}")
        os.close(os.open(path, os.O_CREAT))
        self._locks[path] = os.open(path + ".lock", os.O_CREAT)
        fcntl.flock(self._locks[path], fcntl.LOCK_EX | fcntl.LOCK_NB)

    def replace(self, pid: int, zid: str) -> None:
        """Replace it as if it had reopened its session."""
        path = os.path.join(self.folder, f"{pid}.{zid}")
        os.rename(path, os.path.join(self.folder, "old"))  # so that its inode is not reused
        os.close(os.open(path, os.O_CREAT))

    def links(self, zid: str, *, answers: bool) -> None:
        """Add a link to it, which does or does not carry questions."""
        self.session.links.add(zid)
        (self.session.answering.add if answers else self.session.answering.discard)(zid)

    def reopened(self, seconds: float) -> int:
        """Return how often the session would be reopened in this time, with one poll per second."""
        times = 0
        for _ in range(int(seconds)):
            self.now += 1.0
            times += self.watch.has_lost_its_place() and self.watch._still_lost(self.folder)
        return times

    def close(self) -> None:
        for each in self._locks.values():
            os.close(each)


@pytest.fixture
def bench(tmp_path, monkeypatch) -> Iterator[Bench]:
    made = Bench(str(tmp_path), monkeypatch)
    yield made
    made.close()


def test_answering_link_is_asked_once_and_left_alone(bench: Bench) -> None:
    bench.appear(2, OTHER)
    bench.links(OTHER, answers=True)
    assert bench.reopened(1000) == 0
    assert bench.session.asked == [OTHER]


def test_processes_started_within_seconds_are_asked_together_and_later_ones_alone(bench: Bench) -> None:
    for number in range(4):
        bench.appear(10 + number, f"{number}" * 8)
        bench.links(f"{number}" * 8, answers=True)
        assert bench.reopened(1) == 0
    bench.reopened(100)
    assert bench.session.asked == ["*"]
    bench.appear(2, OTHER)
    bench.links(OTHER, answers=True)
    bench.reopened(100)
    assert bench.session.asked == ["*", OTHER]


def test_process_that_leaves_at_once_is_not_asked(bench: Bench) -> None:
    bench.appear(2, OTHER)
    bench.links(OTHER, answers=True)
    bench.reopened(1)
    os.unlink(os.path.join(bench.folder, f"2.{OTHER}"))
    bench.reopened(100)
    assert bench.session.asked == []


def test_link_that_carries_nothing_is_repaired_after_the_grace_period(bench: Bench) -> None:
    bench.appear(2, OTHER)
    bench.links(OTHER, answers=False)
    assert bench.reopened(LINK_TIMEOUT_S) == 0
    assert bench.reopened(1) == 1
    bench.links(OTHER, answers=True)
    assert bench.reopened(1000) == 0


def test_missing_link_is_repaired_too(bench: Bench) -> None:
    bench.appear(2, OTHER)
    assert (bench.reopened(LINK_TIMEOUT_S), bench.reopened(1)) == (0, 1)


def test_one_of_a_pair_reopens_before_the_other(bench: Bench) -> None:
    bench.appear(2, LOWER)
    bench.links(LOWER, answers=False)
    assert (bench.reopened(2 * LINK_TIMEOUT_S), bench.reopened(1)) == (0, 1)


def test_grace_period_is_longer_on_a_busy_machine(bench: Bench) -> None:
    bench.appear(2, OTHER)
    bench.links(OTHER, answers=False)
    bench.slowness = 10.0
    assert (bench.reopened(10 * LINK_TIMEOUT_S), bench.reopened(1)) == (0, 1)


def test_grace_period_grows_with_each_reopening(bench: Bench) -> None:
    bench.appear(2, OTHER)
    bench.links(OTHER, answers=False)
    assert bench.reopened(LINK_TIMEOUT_S + 1) == 1
    bench.links(OTHER, answers=True)
    bench.appear(3, THIRD)
    bench.links(THIRD, answers=False)
    assert (bench.reopened(2 * LINK_TIMEOUT_S), bench.reopened(1)) == (0, 1)


def test_slowness_follows_the_load_of_the_machine(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "cpu_count", lambda: 2)
    for load, expected in ((0.1, 1.0), (7.0, 1.0), (80.0, 10.0)):
        monkeypatch.setattr(os, "getloadavg", lambda load=load: (load, 0.0, 0.0))
        assert watching.slowness() == expected


def test_silent_process_counts_as_the_same_after_reopening_its_session(bench: Bench) -> None:
    bench.appear(2, OTHER)
    bench.links(OTHER, answers=False)
    times = 0
    for _ in range(10):
        times += bench.reopened(20 * LINK_TIMEOUT_S)
        bench.replace(2, OTHER)
    assert times == MAX_REOPENS


def test_late_answer_prevents_repair(bench: Bench) -> None:
    bench.appear(2, OTHER)
    bench.links(OTHER, answers=False)
    assert bench.reopened(LINK_TIMEOUT_S) == 0
    bench.links(OTHER, answers=True)
    assert bench.reopened(1000) == 0


def test_frozen_process_is_left_alone_and_has_its_grace_period_when_it_continues(bench: Bench) -> None:
    bench.appear(2, OTHER)
    bench.links(OTHER, answers=False)
    assert bench.reopened(LINK_TIMEOUT_S - 1) == 0
    bench.stopped.add(2)
    assert bench.reopened(1000) == 0
    bench.stopped.clear()
    assert bench.reopened(LINK_TIMEOUT_S) == 0
    assert bench.reopened(2) == 1


def test_reopenings_for_a_silent_process_are_limited(bench: Bench) -> None:
    bench.appear(2, OTHER)
    bench.links(OTHER, answers=False)
    assert bench.reopened(4000) == MAX_REOPENS
    bench.appear(3, THIRD)
    bench.links(THIRD, answers=True)
    assert bench.reopened(1000) == 0


def test_link_cut_and_reestablished_is_asked_again(bench: Bench) -> None:
    bench.appear(2, OTHER)
    bench.links(OTHER, answers=True)
    assert bench.reopened(100) == 0
    bench.session.changed(OTHER + "1" * 24, False)
    bench.links(OTHER, answers=False)
    assert bench.reopened(LINK_TIMEOUT_S + 1) == 1


def test_new_session_in_the_same_place_is_asked_again(bench: Bench) -> None:
    bench.appear(2, OTHER)
    bench.links(OTHER, answers=True)
    assert bench.reopened(100) == 0
    bench.replace(2, OTHER)
    bench.links(OTHER, answers=False)
    assert bench.reopened(LINK_TIMEOUT_S + 1) == 1


def test_nothing_is_done_if_the_other_side_repairs_the_link(bench: Bench) -> None:
    bench.appear(2, OTHER)
    bench.links(OTHER, answers=False)
    bench.reopened(LINK_TIMEOUT_S)
    bench.now += 1
    assert bench.watch.has_lost_its_place()
    bench.replace(2, OTHER)
    assert not bench.watch._still_lost(bench.folder)


def test_deleted_socket_is_noticed_at_once(bench: Bench) -> None:
    assert bench.reopened(10) == 0
    os.unlink(bench.session.socket.path)
    assert bench.watch.has_lost_its_place()


def test_killed_process_is_removed_without_reopening(bench: Bench) -> None:
    bench.appear(2, OTHER)
    os.close(bench._locks.pop(os.path.join(bench.folder, f"2.{OTHER}")))
    assert bench.reopened(100) == 0
    assert not os.path.exists(os.path.join(bench.folder, f"2.{OTHER}"))
