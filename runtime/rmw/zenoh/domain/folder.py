"""The folder of a ROS domain, through which the processes of one user on one machine discover each other.

Like tmux's folder, it is in `/tmp`, named after the user and closed to everybody else. The login session's runtime
folder (XDG_RUNTIME_DIR) is unsuitable because it is removed at the last logout, while a robot may keep running.
"""

from __future__ import annotations

import os
import stat
import sys

from bot_console.runtime.rmw.zenoh.domain import loopback

BASE_VARIABLE = "BOT_CONSOLE_SOCKET_DIR"
"""Environment variable that names another base folder: for tests, or to run several systems side by side."""

MAX_PATH_BYTES = 107 if sys.platform == "linux" else 103
"""Maximum length of a Unix socket's path in bytes; connecting to a longer one fails without an error."""
MAX_NAME_BYTES = len("4194304.01234567")
"""Length of a socket's name in bytes: the longest process id, and the first 8 digits of a session's id."""


class FolderRefusedError(RuntimeError):
    """A folder is not safe to use, or no socket can be created in it; the message says why and how to fix it."""


def base_folder() -> str:
    """Return the folder that holds one folder per domain; it need not exist yet."""
    named = os.environ.get(BASE_VARIABLE)
    if named:
        return os.path.abspath(named)
    return os.path.join(_temporary_folder(), f"bot-console-{_user()}")


def names_in(folder: str) -> list[str]:
    """Return the names of the files in a domain's folder; none if somebody has deleted it."""
    try:
        return os.listdir(folder)
    except (FileNotFoundError, NotADirectoryError):
        return []


def domain_folder(domain: int) -> str:
    """Return the folder of a domain, created with mode 0700 if missing.

    Raises `FolderRefusedError` if it or the base folder belongs to another user or is open to others, or if the path of
    a socket in it could be too long.
    """
    base = base_folder()
    folder = os.path.join(base, str(domain))
    room = MAX_PATH_BYTES - MAX_NAME_BYTES - 1
    length = len(os.fsencode(folder))
    if length > room and not loopback.is_chosen():
        problem = f"the path {folder} has {length} bytes, and with more than {room} no socket can be made in it"
        raise FolderRefusedError(f"{problem}: set {BASE_VARIABLE} to a shorter folder")
    _private_folder(base)
    _private_folder(folder)
    return folder


def runtime_folder(name: str) -> str:
    """Return a folder for other short-lived files of the user, created and checked like a domain's folder."""
    base = base_folder()
    folder = os.path.join(base, name)
    _private_folder(base)
    _private_folder(folder)
    return folder


def _user() -> int:
    """Return the user id; 0 on Windows, where the temporary folder is private to the user and has no mode."""
    return os.geteuid() if hasattr(os, "geteuid") else 0


def _temporary_folder() -> str:
    """Return `/tmp` whatever TMPDIR says: programs in two terminals with different values would not find each other."""
    if os.path.isdir("/tmp"):
        return "/tmp"
    import tempfile

    return tempfile.gettempdir()


def _private_folder(path: str) -> None:
    """Create a private folder of the user, or check that an existing one is private."""
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
    """Say what is wrong with a folder and how to fix it; empty if nothing is wrong. Does not follow links."""
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
