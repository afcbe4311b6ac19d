"""Saves every file that the console writes: completely or not at all."""

from __future__ import annotations

import contextlib
import os
import stat
import time
from collections.abc import Callable
from pathlib import Path

PREFIX, SUFFIX = ".bot-console-", ".saving"
"""Prefix and suffix of the temporary file; it does not contain the file's own name, which may have the maximum length
already.
"""
LEFTOVER_AGE_S = 600.0
"""Seconds after which a temporary file counts as left behind by a killed program."""


class NotSaved(OSError):
    """A file could not be saved and its old content is intact; the text names the file and says why."""


def typed_path(text: str) -> Path:
    """The path that a person typed, with `~` expanded; raises `NotSaved` for a text that cannot be a path."""
    text = text.strip()
    if not text or "\0" in text:
        raise NotSaved("give a file name" if not text else "a file name cannot hold a zero byte")
    try:
        os.fsencode(text)
    except UnicodeEncodeError:
        raise NotSaved(f"{text!a} has characters that no file name holds") from None
    try:
        return Path(text).expanduser()
    except RuntimeError:
        raise NotSaved(f"{text}: there is no user of that name, or no home folder") from None


def save_file(path: Path, content: str | bytes, check: Callable[[bytes], None] | None = None) -> None:
    """Write a file, creating its folder if necessary; text is written as UTF-8 with its line ends unchanged.

    The content is written beside the file, synced to disk, read back, passed to `check`, and only then renamed: after a
    full disk, a crash or an error in `check` the old content is intact. A symbolic link stays a link; mode and owner
    stay; a new file follows the umask. Raises `NotSaved`, and whatever `check` raises.
    """
    try:
        _save(path, content.encode() if isinstance(content, str) else content, check)
    except NotSaved:
        raise
    except UnicodeEncodeError as error:
        raise NotSaved(f"{path}: cannot be written as UTF-8: {error.reason}") from None
    except OSError as error:
        raise NotSaved(f"{path}: {_reason(path, error)}") from error


def _reason(path: Path, error: OSError) -> str:
    if not path.is_absolute():
        try:
            os.getcwd()
        except OSError:
            return "the working folder has been deleted; give the whole path"
    text = error.strerror or str(error)
    return text[:1].lower() + text[1:]


def _save(path: Path, content: bytes, check: Callable[[bytes], None] | None) -> None:
    # The rename must replace the target of a link, not the link.
    target = Path(os.path.realpath(path))
    old = _replaceable(path, target)
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise NotSaved(f"{path}: its folder cannot be made: {_reason(target, error)}") from error
    _delete_leftovers(target.parent)
    temporary = target.parent / f"{PREFIX}{os.urandom(4).hex()}{SUFFIX}"
    try:
        _write(temporary, content, 0o666 if old is None else 0o600)
        if old is not None:
            _copy_owner_and_mode(temporary, old, path)
        written = temporary.read_bytes()
        if written != content:
            raise NotSaved(f"{path}: the disk gives back something else than was written")
        if check is not None:
            check(written)
        temporary.replace(target)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise
    _sync_folder(target.parent)


def _replaceable(path: Path, target: Path) -> os.stat_result | None:
    """The status of the existing file; raises `NotSaved` for one that must not be replaced."""
    try:
        old = target.stat()
    except FileNotFoundError:
        return None
    if stat.S_ISDIR(old.st_mode):
        raise NotSaved(f"{path} is a folder; add a file name")
    if not stat.S_ISREG(old.st_mode):
        raise NotSaved(f"{path} is not a regular file; give another name")
    if not os.access(target, os.W_OK) or not old.st_mode & 0o222:
        raise NotSaved(f"{path} is write-protected; give another name, or make it writable")
    return old


def _write(path: Path, content: bytes, mode: int) -> None:
    # The kernel applies the umask to the mode: a program cannot read its umask without setting it.
    flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0)
    with os.fdopen(os.open(path, flags, mode), "wb") as file:
        file.write(content)
        file.flush()
        os.fsync(file.fileno())


def _copy_owner_and_mode(new: Path, old: os.stat_result, path: Path) -> None:
    """Give a file the owner and mode of the one it replaces."""
    now = new.stat()
    if hasattr(os, "chown") and (now.st_uid, now.st_gid) != (old.st_uid, old.st_gid):
        try:
            os.chown(new, old.st_uid, old.st_gid)
        except PermissionError:
            raise NotSaved(f"{path} belongs to somebody else, which saving would change; give another name") from None
    # After the owner, since changing the owner clears some bits of the mode.
    new.chmod(stat.S_IMODE(old.st_mode))


def _sync_folder(folder: Path) -> None:
    """Make the rename survive a power failure, where folders can be opened and the file system syncs them."""
    if os.name == "posix":
        with contextlib.suppress(OSError):
            descriptor = os.open(folder, os.O_RDONLY)
            try:
                os.fsync(descriptor)
            finally:
                os.close(descriptor)


def _delete_leftovers(folder: Path) -> None:
    """Delete what an interrupted save left behind."""
    for each in folder.glob(f"{PREFIX}*{SUFFIX}"):
        with contextlib.suppress(OSError):
            if time.time() - each.stat().st_mtime > LEFTOVER_AGE_S:
                each.unlink()
