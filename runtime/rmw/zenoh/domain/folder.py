"""The folder of a ROS domain: where the processes of one user on one machine find each other.

As tmux does it: in `/tmp`, named after the user, closed to everybody else. Not the login session's folder, which goes
with the last login while a robot may stay.
"""

from __future__ import annotations

import os
import stat
import sys

from bot_console.runtime.rmw.zenoh.domain import loopback

BASE_VARIABLE = "BOT_CONSOLE_SOCKET_DIR"
"""Names another base folder: for tests, and for several systems side by side."""

LONGEST_PATH = 107 if sys.platform == "linux" else 103
"""The bytes that the path of a Unix socket may have; a longer one fails silently on connecting."""
LONGEST_NAME = len("4194304.01234567")
"""The bytes of a socket's name: a process id of the most digits, and the begin of a session's id."""


class FolderRefusedError(RuntimeError):
    """A folder is not safe to meet in, or no socket can be made in it; the text says why and how to mend it."""


def base_folder() -> str:
    """The folder that holds one folder per domain; it need not be there yet."""
    named = os.environ.get(BASE_VARIABLE)
    if named:
        return os.path.abspath(named)
    return os.path.join(_temporary_folder(), f"bot-console-{_user()}")


def domain_folder(domain: int) -> str:
    """The folder of a domain, made with mode 0700 where it is missing.

    Raises `FolderRefusedError` where it, or the base folder, belongs to somebody else or is open to others, and where
    the path of a socket in it could be too long.
    """
    base = base_folder()
    folder = os.path.join(base, str(domain))
    room = LONGEST_PATH - LONGEST_NAME - 1
    length = len(os.fsencode(folder))
    if length > room and not loopback.is_chosen():
        told = f"the path {folder} has {length} bytes, and with more than {room} no socket can be made in it"
        raise FolderRefusedError(f"{told}: set {BASE_VARIABLE} to a shorter folder")
    _private_folder(base)
    _private_folder(folder)
    return folder


def _user() -> int:
    """The id of the user; 0 on Windows, where the temporary folder is the user's own and has no mode."""
    return os.geteuid() if hasattr(os, "geteuid") else 0


def _temporary_folder() -> str:
    """`/tmp` whatever TMPDIR says: two terminals with different ones would never meet."""
    if os.path.isdir("/tmp"):
        return "/tmp"
    import tempfile

    return tempfile.gettempdir()


def _private_folder(path: str) -> None:
    """Make a folder of the user's alone, or check that it is one."""
    try:
        os.mkdir(path, 0o700)
    except FileExistsError:
        pass
    except OSError as error:
        raise FolderRefusedError(
            f"cannot make the folder {path} ({error.strerror}): set {BASE_VARIABLE} to a folder of yours"
        ) from None
    problem = _problem(path)
    if problem:
        raise FolderRefusedError(f"{path} {problem}; or set {BASE_VARIABLE} to another folder of yours")


def _problem(path: str) -> str:
    """What is wrong with a folder, and how to mend it; empty where all is well. Links are not followed."""
    found = os.lstat(path)
    if stat.S_ISLNK(found.st_mode):
        return "is a symbolic link, which somebody else may have put there: remove it"
    if not stat.S_ISDIR(found.st_mode):
        return "is not a folder: remove it"
    if found.st_uid != _user():
        return f"belongs to another user (uid {found.st_uid}): ask its owner to remove it"
    if found.st_mode & 0o077 and hasattr(os, "geteuid"):
        return f"is open to other users (mode {stat.S_IMODE(found.st_mode):04o}): run `chmod 700 {path}`"
    return ""
