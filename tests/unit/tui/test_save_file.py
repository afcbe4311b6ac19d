"""Saving any file: all or nothing; mode, links and owner are kept."""

from __future__ import annotations

import errno
import os
import stat
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import NoReturn

import pytest
from bot_console.tui.files import save_file as module
from bot_console.tui.files.save_file import NotSaved, save_file, typed_path

POSIX = pytest.mark.skipif(os.name != "posix", reason="needs POSIX permissions and owners")


def mode(path: Path) -> int:
    return stat.S_IMODE(path.stat().st_mode)


def names(folder: Path) -> list[str]:
    return sorted(each.name for each in folder.iterdir())


@pytest.fixture
def umask() -> Iterator[None]:
    old = os.umask(0o027)
    yield
    os.umask(old)


@POSIX
@pytest.mark.usefixtures("umask")
def test_a_new_file_and_its_folder_follow_the_umask(tmp_path: Path) -> None:
    path = tmp_path / "new" / "log.txt"
    save_file(path, "one\r\ntwo\n")
    assert path.read_bytes() == b"one\r\ntwo\n"
    assert (mode(path), mode(path.parent)) == (0o640, 0o750)
    assert names(path.parent) == ["log.txt"]


@POSIX
@pytest.mark.parametrize("rights", [0o600, 0o644, 0o664, 0o755, 0o4755])
def test_saving_keeps_the_mode(tmp_path: Path, rights: int) -> None:
    path = tmp_path / "file"
    path.write_text("old")
    path.chmod(rights)
    save_file(path, "new")
    assert (path.read_text(), oct(mode(path))) == ("new", oct(rights))


@POSIX
def test_saving_keeps_symbolic_links_even_dangling_ones(tmp_path: Path) -> None:
    (tmp_path / "deep").mkdir()
    link = tmp_path / "link"
    link.symlink_to("deep/file")
    for text in ("first", "second"):
        save_file(link, text)
        assert link.is_symlink()
        assert (tmp_path / "deep" / "file").read_text() == text
    assert names(tmp_path / "deep") == ["file"]


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() != 0, reason="only root can change the owner of a file")
def test_saving_keeps_the_owner(tmp_path: Path) -> None:
    path = tmp_path / "file"
    path.write_text("old")
    os.chown(path, 1234, 2345)
    path.chmod(0o640)
    save_file(path, "new")
    assert (path.stat().st_uid, path.stat().st_gid, mode(path)) == (1234, 2345, 0o640)


@POSIX
def test_a_file_whose_owner_cannot_be_kept_is_left_alone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "file"
    path.write_text("old")
    real = Path.stat

    def others(self: Path, **options: bool) -> os.stat_result:
        found = real(self, **options)
        return os.stat_result((*found[:4], 4321, *found[5:])) if self == path else found

    def refuse(*_: object) -> NoReturn:
        raise PermissionError(errno.EPERM, "Operation not permitted")

    monkeypatch.setattr(Path, "stat", others)
    monkeypatch.setattr(os, "chown", refuse)
    with pytest.raises(NotSaved, match="belongs to somebody else"):
        save_file(path, "new")
    assert (path.read_text(), names(tmp_path)) == ("old", ["file"])


@pytest.mark.parametrize("failing", ["write", "fsync", "rename"])
def test_full_disk_keeps_the_old_content(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, failing: str) -> None:
    path = tmp_path / "file"
    path.write_text("old")

    def full(*_: object) -> NoReturn:
        raise OSError(errno.ENOSPC, "No space left on device", "some other name")

    if failing == "write":
        monkeypatch.setattr(module, "_write", full)
    elif failing == "fsync":
        monkeypatch.setattr(os, "fsync", full)
    else:
        monkeypatch.setattr(Path, "replace", full)
    with pytest.raises(NotSaved) as caught:
        save_file(path, "new" * 1000)
    assert str(caught.value) == f"{path}: no space left on device"
    assert (path.read_text(), names(tmp_path)) == ("old", ["file"])


@POSIX
def test_file_size_limit_keeps_the_old_content(tmp_path: Path) -> None:
    import resource
    import signal

    path = tmp_path / "file"
    path.write_text("old")
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    handler = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (4096, before[1]))
    try:
        with pytest.raises(NotSaved, match="too large"):
            save_file(path, b"x" * 100_000)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
        signal.signal(signal.SIGXFSZ, handler)
    assert (path.read_text(), names(tmp_path)) == ("old", ["file"])


def test_content_that_fails_the_check_keeps_the_old_content(tmp_path: Path) -> None:
    path = tmp_path / "file"
    path.write_text("old")

    def check(written: bytes) -> None:
        raise ValueError(f"{len(written)} bytes")

    with pytest.raises(ValueError, match="3 bytes"):
        save_file(path, "new", check)
    assert (path.read_text(), names(tmp_path)) == ("old", ["file"])


def test_file_that_must_not_be_replaced_is_named(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("old")
    with pytest.raises(NotSaved, match="is a folder; add a file name"):
        save_file(tmp_path, "new")
    with pytest.raises(NotSaved, match="not a directory"):
        save_file(tmp_path / "file" / "below", "new")
    with pytest.raises(NotSaved, match="too long"):
        save_file(tmp_path / ("x" * 300), "new")
    with pytest.raises(NotSaved, match="cannot be written as UTF-8"):
        save_file(tmp_path / "file", "\udc80")
    assert (tmp_path / "file").read_text() == "old"


@POSIX
def test_devices_pipes_and_protected_files_are_not_replaced(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("old")
    (tmp_path / "file").chmod(0o444)
    with pytest.raises(NotSaved, match="write-protected"):
        save_file(tmp_path / "file", "new")
    os.mkfifo(tmp_path / "pipe")
    for each in (tmp_path / "pipe", Path(os.devnull)):
        with pytest.raises(NotSaved, match="is not a regular file; give another name"):
            save_file(each, "new")
    assert stat.S_ISFIFO((tmp_path / "pipe").stat().st_mode)


def test_file_name_of_maximum_length_is_saved(tmp_path: Path) -> None:
    path = tmp_path / ("x" * 255)
    save_file(path, "new")
    assert path.read_text() == "new"


def test_remains_of_a_killed_save_are_deleted_later(tmp_path: Path) -> None:
    old, young = (tmp_path / f"{module.PREFIX}{each}{module.SUFFIX}" for each in ("old", "young"))
    for each in (old, young):
        each.write_text("half")
    past = time.time() - 2 * module.LEFTOVER_AGE_S
    os.utime(old, (past, past))
    save_file(tmp_path / "file", "new")
    assert names(tmp_path) == sorted([young.name, "file"])


def test_folder_that_cannot_be_created_is_reported(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object, **__: object) -> None:
        raise PermissionError(errno.EACCES, "Permission denied")

    monkeypatch.setattr(Path, "mkdir", refuse)
    path = tmp_path / "profiles" / "mine.yaml"
    with pytest.raises(NotSaved) as caught:
        save_file(path, "a")
    assert str(caught.value) == f"{path}: its folder cannot be made: permission denied"


@pytest.mark.skipif(sys.platform == "win32", reason="Windows cannot delete a working folder")
def test_a_deleted_working_folder_is_reported(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    gone = tmp_path / "gone"
    gone.mkdir()
    monkeypatch.chdir(gone)
    gone.rmdir()
    with pytest.raises(NotSaved, match="the working folder has been deleted; give the whole path"):
        save_file(Path("log.txt"), "new")


@pytest.mark.parametrize(
    ("text", "why"),
    [("", "give a file name"), ("  ", "give a file name"), ("~nobody-here/x", "no user"), ("a\0b", "zero")],
)
def test_invalid_file_names_are_rejected(text: str, why: str) -> None:
    with pytest.raises(NotSaved, match=why):
        typed_path(text)


def test_a_typed_name_may_begin_in_the_home_folder(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("USERPROFILE", str(tmp_path))
    assert typed_path(" ~/log.txt ") == tmp_path / "log.txt"
