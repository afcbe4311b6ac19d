"""The file in which stops outlive their nodes: its content, its users, and locking if it cannot be used."""

from __future__ import annotations

import contextlib
import json
import os
import stat
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from bot_console_robot.safety import stop_file
from bot_console_robot.safety.lock import Lock, Release, Stop
from bot_console_robot.safety.stop_file import StopFile, StopFileError, UnreadableStopFileError

ANNA, BEN = Stop("a1", "a", "anna", "the arm swings", 1), Stop("b1", "b", "ben", "my foot", 2)
NODES_OWN = Stop("n1", "node", "simulator", "the safety monitor has gone", 3, kept=False)


def at(folder: Path, robot: str = "/") -> StopFile:
    return StopFile(str(folder / "state" / "stops.json"), robot)


def test_stop_and_its_release_survive_a_restart(tmp_path: Path) -> None:
    at(tmp_path).merge(Lock((ANNA, NODES_OWN), 3))
    again = at(tmp_path).merge(Lock())
    assert again.stops == (ANNA,), "what a node found in its present run ends with it"
    at(tmp_path).merge(again.without(["a1"], "ben"))
    assert at(tmp_path).merge(Lock()) == Lock((), 4, (Release("a1", "ben", 4),))


def test_two_locks_writing_in_turn_lose_nothing_and_revive_nothing(tmp_path: Path) -> None:
    at(tmp_path).merge(Lock((ANNA,), 1))
    both = at(tmp_path).merge(Lock((BEN,), 2))
    assert both.ids == {"a1", "b1"}
    at(tmp_path).merge(both.without(["a1"], "carla"))
    assert at(tmp_path).merge(Lock((ANNA, BEN), 2)).ids == {"b1"}, "this lock has not received the release"


def test_file_is_written_only_where_it_lacks_something(tmp_path: Path) -> None:
    path = tmp_path / "state" / "stops.json"
    one, other = at(tmp_path), at(tmp_path)
    one.merge(Lock((ANNA,), 1))
    assert one.is_as_left and not other.is_as_left
    other.merge(Lock((BEN,), 2))
    assert other.is_as_left and not one.is_as_left, "it has to learn what the other one has written"
    known = one.merge(Lock((ANNA,), 1))
    assert known.ids == {"a1", "b1"} and one.is_as_left and other.is_as_left, (
        "otherwise they would write in turn forever"
    )
    path.unlink()
    assert not one.is_as_left
    one.merge(known)
    assert one.is_as_left and at(tmp_path).merge(Lock()).ids == {"a1", "b1"}


def test_robots_of_one_domain_do_not_lock_each_other(tmp_path: Path) -> None:
    at(tmp_path, "/one").merge(Lock((ANNA,), 1))
    assert not at(tmp_path, "/two").merge(Lock()).held
    assert at(tmp_path, "/one").merge(Lock()).held


@pytest.mark.skipif(os.name == "nt", reason="Windows has no such permissions")
def test_only_owner_may_read_the_file(tmp_path: Path) -> None:
    before = os.umask(0)
    try:
        at(tmp_path).merge(Lock((ANNA,), 1))
    finally:
        os.umask(before)
    folder = tmp_path / "state"
    assert stat.S_IMODE(folder.stat().st_mode) == 0o700
    assert {stat.S_IMODE(each.stat().st_mode) for each in folder.iterdir()} == {0o600}


@pytest.mark.parametrize("turn", [-1, 2**63 + 1, 10**300])
def test_turn_that_is_not_read_back_as_the_same_number_makes_the_file_unreadable(tmp_path: Path, turn: int) -> None:
    path = tmp_path / "stops.json"
    path.write_text(json.dumps({"version": 1, "robots": {"/": {"turn": turn, "stops": [], "released": []}}}))
    with pytest.raises(UnreadableStopFileError, match="turn"):
        StopFile(str(path), "/").merge(Lock())


VALID = {"version": 1, "robots": {"/": {"turn": 1, "stops": [["a", "anna", "now", 1, "a1", True]], "released": []}}}


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"[]",
        b"\xff\xfe",
        b"{" * 100_000,
        json.dumps({**VALID, "version": 2}).encode(),
        json.dumps({"version": 1}).encode(),
        json.dumps(VALID).encode()[:-9],
        json.dumps(VALID).replace('[["a", "anna", "now", 1, "a1", true]]', '["a1"]').encode(),
        json.dumps(VALID).replace('"turn": 1', '"turn": "1"').encode(),
        json.dumps(VALID).replace('"released": []', '"released": [["b1"]]').encode(),
    ],
)
def test_file_with_other_content_is_replaced_only_on_request(content: bytes, tmp_path: Path) -> None:
    path = tmp_path / "state" / "stops.json"
    path.parent.mkdir()
    path.write_bytes(content)
    with pytest.raises(UnreadableStopFileError, match="cannot be read"):
        at(tmp_path).merge(Lock((ANNA,), 1))
    assert path.read_bytes() == content
    assert at(tmp_path).merge(Lock((BEN,), 1), replace_unreadable=True).ids == {"b1"}
    assert path.with_name("stops.json.unreadable").read_bytes() == content
    assert at(tmp_path).merge(Lock()).ids == {"b1"}


@pytest.mark.skipif(os.name == "nt", reason="Windows has no such files")
@pytest.mark.parametrize("make", [os.mkfifo, os.mkdir, lambda path: path.symlink_to("/dev/zero")])
def test_anything_but_a_regular_file_is_refused_at_once(tmp_path: Path, make: Callable[[Path], object]) -> None:
    path = tmp_path / "stops.json"
    make(path)
    with pytest.raises(UnreadableStopFileError, match=f"{path} cannot be read"):
        StopFile(str(path), "/").merge(Lock())
    StopFile(str(path), "/").merge(Lock((ANNA,), 1), replace_unreadable=True)
    assert StopFile(str(path), "/").merge(Lock()).ids == {"a1"}


@pytest.mark.skipif(os.name == "nt", reason="Windows has no such files")
@pytest.mark.parametrize("name", ["", "folder", "/dev/null", "/dev/zero"])
def test_folder_or_device_is_neither_used_nor_moved_aside(
    tmp_path: Path, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Path, "replace", lambda *_: pytest.fail("it was moved"))
    monkeypatch.setattr(StopFile, "_locked_file", lambda _: contextlib.nullcontext())  # its lock file stays out of /dev
    (tmp_path / "folder" / "inner").mkdir(parents=True)
    for replaces in (False, True):
        with pytest.raises(StopFileError, match="is a folder or a device"):
            StopFile(str(tmp_path / name), "/").merge(Lock(), replace_unreadable=replaces)


def test_valid_file_is_read(tmp_path: Path) -> None:
    path = tmp_path / "state" / "stops.json"
    path.parent.mkdir()
    path.write_text(json.dumps(VALID))
    assert at(tmp_path).merge(Lock()).ids == {"a1"}


def test_unwritable_place_is_an_error(tmp_path: Path) -> None:
    (tmp_path / "state").write_text("a file where the folder should be")
    with pytest.raises(StopFileError, match="cannot be written"):
        at(tmp_path).merge(Lock())


def test_error_names_the_very_file(tmp_path: Path) -> None:
    """For example a file of root, if the robot was once started by `sudo`."""
    (tmp_path / "state" / "stops.json.lock").mkdir(parents=True)
    with pytest.raises(StopFileError, match=r"stops\.json\.lock cannot be written"):
        at(tmp_path).merge(Lock())


def test_full_disk_is_an_error_and_keeps_the_old_content(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(handle: int) -> None:
        raise OSError(28, "No space left on device")

    at(tmp_path).merge(Lock((ANNA,), 1))
    with monkeypatch.context() as broken:
        broken.setattr(os, "fsync", full)
        file = at(tmp_path)
        with pytest.raises(StopFileError, match="No space left on device"):
            file.merge(Lock((ANNA, BEN), 2).without(["a1"], "ben"))
        assert not file.is_as_left
        with pytest.raises(StopFileError, match="No space left on device"):
            file.merge(Lock())
    assert at(tmp_path).merge(Lock()).ids == {"a1"}


def test_wait_for_a_locked_file_ends_at_its_timeout(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stop_file, "TURN_TIMEOUT_S", 0.0)
    monkeypatch.setattr(stop_file, "TURN_POLL_S", 0.0)
    with at(tmp_path)._locked_file(), pytest.raises(StopFileError, match="another process has locked it"):
        at(tmp_path).merge(Lock((ANNA,), 1))


WRITER = """
import sys
from bot_console.runtime.importer import install
install()
from bot_console_robot.safety import stop_file
from bot_console_robot.safety.lock import Lock, Stop
from bot_console_robot.safety.stop_file import StopFile
stop_file.TURN_TIMEOUT_S = 60.0  # A busy machine may give the other writer no time for longer than a robot could wait.
for number in range(20):
    StopFile(sys.argv[1], "/").merge(Lock((Stop(f"{sys.argv[2]}{number}", sys.argv[2], turn=1),), 1))
"""


def test_concurrent_writers_lose_nothing(tmp_path: Path) -> None:
    path = str(tmp_path / "stops.json")
    writers = [subprocess.Popen([sys.executable, "-c", WRITER, path, name]) for name in "ab"]
    assert [each.wait() for each in writers] == [0, 0]
    kept = StopFile(path, "/").merge(Lock())
    assert kept.ids == {f"{name}{number}" for name in "ab" for number in range(20)}


class Clock:
    """Time that passes only while a lock sleeps; at `release_s` the other lock has written and unlocks the file."""

    def __init__(self, release: Callable[[], object], release_s: float) -> None:
        self.now = 0.0
        self._release, self._release_s = release, release_s

    def monotonic(self) -> float:
        return self.now

    def sleep(self, seconds: float) -> None:
        self.now += seconds
        if self.now >= self._release_s:
            self._release()


@pytest.mark.skipif(os.name == "nt", reason="needs POSIX file locks")
@pytest.mark.parametrize(("release_s", "written"), [(0.5, True), (4.5, True), (60.0, False)])
def test_lock_waits_five_seconds_for_the_other_one_to_write_the_file(
    release_s: float, written: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import fcntl  # Windows has none

    at(tmp_path).merge(Lock((ANNA,), 1))
    other = os.open(tmp_path / "state" / "stops.json.lock", os.O_RDWR)
    try:
        fcntl.flock(other, fcntl.LOCK_EX)
        clock = Clock(lambda: fcntl.flock(other, fcntl.LOCK_UN), release_s)
        monkeypatch.setattr(stop_file, "time", clock)
        if written:
            assert at(tmp_path).merge(Lock((BEN,), 2)).ids == {"a1", "b1"}
            assert clock.now == pytest.approx(release_s, abs=0.05)
        else:
            with pytest.raises(StopFileError, match="another process has locked it"):
                at(tmp_path).merge(Lock((BEN,), 2))
            assert clock.now == pytest.approx(5.0, abs=0.1)
    finally:
        os.close(other)
