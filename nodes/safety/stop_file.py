"""The stop file, in which stops of a domain's robots, and releases, outlive the nodes. For POSIX and Windows."""

from __future__ import annotations

import contextlib
import json
import os
import stat
import time
from collections.abc import Generator
from dataclasses import replace
from pathlib import Path
from typing import Any, cast

from bot_console_robot.safety.lock import Lock
from bot_console_robot.safety.stop_messages import parse_releases, parse_stops, releases_text, stops_text

VERSION = 1
MAX_FILE_BYTES = 4_000_000
"""Maximum size of the file, which a lock never reaches."""
MAX_TURN = 2**63
"""Maximum turn, which a lock never reaches."""
TURN_TIMEOUT_S = 5.0
"""Seconds to wait for another lock that uses the file; on a busy disk, writing it takes more than one second."""
TURN_POLL_S = 0.01


class StopFileError(Exception):
    """The file cannot be read or written; the text says why."""

    effect = "stops cannot be kept"
    fix = "free some space, or make it and its folder writable, then release"


class UnreadableStopFileError(StopFileError):
    """The file cannot be read or has other content; it is replaced only when a person releases the robot."""

    effect = "the kept stops are unknown"
    fix = "a release moves that file aside"


class NoStopFileError(StopFileError):
    """A folder with content or a device has been named; it must not be moved aside."""

    fix = "give the nodes the path of a file (the parameter stop_file), and start them again"


class StopFile:
    """The stops of one robot in the file, which both locks of a robot, and several robots, may share."""

    def __init__(self, path: str, robot: str) -> None:
        """`robot` is the namespace of the robot's nodes."""
        self._path = Path(path)
        self._robot = robot
        self._left: tuple[int, int, int] | None = None
        """Inode, modification time and size of the file after the last merge; None if that failed."""

    @property
    def is_as_left(self) -> bool:
        """Whether the last merge succeeded, and nobody has replaced or deleted the file since then."""
        return self._left is not None and self._identity() == self._left

    def _identity(self) -> tuple[int, int, int] | None:
        try:
            found = self._path.stat()
        except OSError:
            return None
        return found.st_ino, found.st_mtime_ns, found.st_size

    def merge(self, lock: Lock, *, replace_unreadable: bool = False) -> Lock:
        """Merge a lock with the file, and return the merged lock; raises `StopFileError`.

        Stops that end with the robot's nodes are not written. With `replace_unreadable`, a file that cannot be read is
        moved aside. The first time, and after a failure, the file is written even if nothing has changed, to find out
        whether that is possible.
        """
        must_write, self._left = self._left is None, None
        try:
            with self._locked_file():
                robots = self._read(replace_unreadable)
                both = _lock_of(robots.get(self._robot)).merged(replace(lock.kept, turn=lock.turn))
                section = {
                    "turn": both.turn,
                    "stops": json.loads(stops_text(both.stops)),
                    "released": json.loads(releases_text(both.released)),
                }
                if must_write or robots.get(self._robot) != section:
                    self._write({**robots, self._robot: section})
                self._left = self._identity()
        except OSError as error:
            place, why = error.filename or self._path, error.strerror or error
            raise StopFileError(f"{place} cannot be written: {why}") from None
        return lock.merged(both)

    @contextlib.contextmanager
    def _locked_file(self) -> Generator[None, None, None]:
        """Keep other locks from using the file; raises `OSError` if one of them does not release it in time."""
        self._path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        handle = os.open(f"{self._path}.lock", os.O_RDWR | os.O_CREAT | getattr(os, "O_NOFOLLOW", 0), 0o600)
        try:
            deadline = time.monotonic() + TURN_TIMEOUT_S
            while not _try_lock(handle):
                if time.monotonic() > deadline:
                    raise OSError("another process has locked it")
                time.sleep(TURN_POLL_S)
            yield
        finally:
            os.close(handle)

    def _read(self, replace_unreadable: bool) -> dict[str, Any]:
        try:
            return self._robots()
        except FileNotFoundError:
            return {}
        except (OSError, ValueError, RecursionError) as error:
            if not self._is_movable():
                raise NoStopFileError(f"{self._path} is a folder or a device") from None
            if replace_unreadable:
                self._path.replace(f"{self._path}.unreadable")
                return {}
            why = (error.strerror if isinstance(error, OSError) else "") or str(error)
            raise UnreadableStopFileError(f"{self._path} cannot be read: {why[:200]}") from None

    def _is_movable(self) -> bool:
        mode = os.lstat(self._path).st_mode
        if stat.S_ISDIR(mode):
            return not os.listdir(self._path)
        return stat.S_ISREG(mode) or stat.S_ISLNK(mode) or stat.S_ISFIFO(mode)

    def _robots(self) -> dict[str, Any]:
        with open(self._path, "rb", opener=_open_at_once) as file:
            if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
                raise ValueError("it is not a regular file")
            content = file.read(MAX_FILE_BYTES + 1)
        if len(content) > MAX_FILE_BYTES:
            raise ValueError("it is too large")
        data = json.loads(content)
        if not isinstance(data, dict) or not isinstance(found := cast("dict[str, Any]", data).get("robots"), dict):
            raise ValueError("it contains no stops")
        if (version := cast("dict[str, Any]", data).get("version")) != VERSION:
            raise ValueError(f"its version is {version!r}, not {VERSION}")
        robots = cast("dict[str, Any]", found)
        _lock_of(robots.get(self._robot))
        return robots

    def _write(self, robots: dict[str, Any]) -> None:
        temporary = self._path.with_name(f"{self._path.name}.new")
        temporary.unlink(missing_ok=True)  # left by a process that was killed while writing
        handle = os.open(temporary, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
        with open(handle, "w", encoding="utf-8") as file:
            json.dump({"version": VERSION, "robots": robots}, file)
            file.flush()
            os.fsync(file.fileno())
        os.replace(temporary, self._path)
        if hasattr(os, "O_DIRECTORY"):
            folder = os.open(self._path.parent, os.O_RDONLY | os.O_DIRECTORY)
            try:
                os.fsync(folder)
            finally:
                os.close(folder)


def _open_at_once(path: str, flags: int) -> int:
    """Open a file; a pipe in its place would otherwise keep the node waiting for a writer."""
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0))


def _lock_of(section: Any) -> Lock:
    """The lock in a robot's section; raises `ValueError` for any invalid content, instead of guessing."""
    if section is None:
        return Lock()
    try:
        turn, stops, released = section["turn"], section["stops"], section["released"]
        if not (isinstance(turn, int) and isinstance(stops, list) and isinstance(released, list)):
            raise TypeError
        if not 0 <= turn <= MAX_TURN:  # the other lock would read a larger number as 0
            raise ValueError(f"its turn is not between 0 and {MAX_TURN}")
    except (TypeError, KeyError):
        raise ValueError("it contains no stops") from None
    lock = Lock(parse_stops(json.dumps(stops)), turn, parse_releases(json.dumps(released)))
    if len(lock.stops) != len(cast("list[Any]", stops)) or len(lock.released) != len(cast("list[Any]", released)):
        raise ValueError("it contains something that is not a stop")
    return lock


def _try_lock(handle: int) -> bool:
    """Lock an open file until it is closed; False if another process has locked it."""
    try:
        import fcntl
    except ImportError:
        return _try_lock_windows(handle)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True


def _try_lock_windows(handle: int) -> bool:
    import msvcrt

    os.lseek(handle, 0, os.SEEK_SET)
    try:
        msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)  # pyright: ignore[reportAttributeAccessIssue, reportUnknownMemberType] -- of Windows
    except PermissionError:
        return False
    return True
