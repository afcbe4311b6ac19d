"""The folder with the sockets of a domain belongs to one user alone."""

from __future__ import annotations

import os
import stat
import subprocess
import sys

import pytest
from bot_console.runtime.rmw.zenoh.domain.folder import (
    MAX_PATH_BYTES,
    FolderRefusedError,
    base_folder,
    domain_folder,
)
from bot_console.runtime.rmw.zenoh.domain.mesh import open_session
from bot_console.runtime.rmw.zenoh.domain.sockets import own_socket

NOBODY = 65534


def test_folder_is_named_after_the_user_regardless_of_tmpdir(monkeypatch):
    monkeypatch.delenv("BOT_CONSOLE_SOCKET_DIR")
    monkeypatch.setenv("TMPDIR", "/var")
    assert base_folder() == f"/tmp/bot-console-{os.geteuid()}"


def test_folder_is_private_and_one_per_domain(socket_folder):
    old = os.umask(0)
    try:
        assert domain_folder(7) == os.path.join(socket_folder, "7")
    finally:
        os.umask(old)
    for path in (socket_folder, domain_folder(7)):
        assert stat.S_IMODE(os.stat(path).st_mode) == 0o700


def test_folder_open_to_others_is_refused_with_a_fix(socket_folder):
    domain_folder(0)
    os.chmod(socket_folder, 0o755)
    with pytest.raises(FolderRefusedError) as refused:
        domain_folder(0)
    assert str(refused.value) == (
        f"{socket_folder} is open to other users (mode 0755): run `chmod 700 {socket_folder}`; "
        "or set BOT_CONSOLE_SOCKET_DIR to another folder of yours"
    )


def test_link_or_file_in_place_of_the_folder_is_refused(socket_folder, tmp_path):
    os.symlink(tmp_path, socket_folder)
    with pytest.raises(FolderRefusedError, match="is a symbolic link"):
        domain_folder(0)
    os.unlink(socket_folder)
    with open(socket_folder, "w"):
        pass
    with pytest.raises(FolderRefusedError, match="is not a folder"):
        domain_folder(0)
    os.unlink(socket_folder)


def test_folder_that_cannot_be_created_is_reported(monkeypatch):
    monkeypatch.setenv("BOT_CONSOLE_SOCKET_DIR", "/proc/nowhere/at/all")
    with pytest.raises(FolderRefusedError, match="cannot make the folder /proc/nowhere/at/all"):
        domain_folder(0)


def test_too_long_folder_is_refused_before_it_is_created(monkeypatch, socket_folder):
    monkeypatch.setenv("BOT_CONSOLE_SOCKET_DIR", socket_folder.ljust(MAX_PATH_BYTES, "x"))
    with pytest.raises(FolderRefusedError, match="set BOT_CONSOLE_SOCKET_DIR to a shorter folder"):
        open_session(0)
    assert not os.path.exists(socket_folder.ljust(MAX_PATH_BYTES, "x"))


def test_longest_accepted_folder_holds_every_socket(monkeypatch, tmp_path):
    monkeypatch.setattr("bot_console.runtime.rmw.zenoh.domain.sockets.getpid", lambda: 4194304)
    monkeypatch.setattr("bot_console.runtime.rmw.zenoh.domain.folder._private_folder", lambda path: None)
    length = len(os.fsencode(own_socket("", "0" * 32).path))
    base = "/".ljust(MAX_PATH_BYTES - length - len("/0/"), "x")
    monkeypatch.setenv("BOT_CONSOLE_SOCKET_DIR", base)
    assert len(os.fsencode(own_socket(domain_folder(0), "0" * 32).path)) == MAX_PATH_BYTES
    monkeypatch.setenv("BOT_CONSOLE_SOCKET_DIR", f"{base}x")
    with pytest.raises(FolderRefusedError):
        domain_folder(0)


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can become another user")
def test_second_user_is_denied(socket_folder):
    session = open_session(0)
    os.chmod(os.path.dirname(socket_folder), 0o711)
    program = f"""
import os, socket
os.setgroups([]); os.setgid({NOBODY}); os.setuid({NOBODY})
try:
    socket.socket(socket.AF_UNIX).connect({session.socket.path!r})
except PermissionError:
    print("denied")
from bot_console.runtime.rmw.zenoh.domain.folder import FolderRefusedError, domain_folder
try:
    domain_folder(0)
except FolderRefusedError as error:
    print(error)
"""
    code = "import bot_console.runtime.rmw.zenoh.domain.folder\n" + program
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    session.close()
    assert result.stdout.splitlines() == [
        "denied",
        f"{socket_folder} belongs to another user (uid 0): ask its owner to remove it; "
        "or set BOT_CONSOLE_SOCKET_DIR to another folder of yours",
    ]


def test_folder_named_like_a_dead_socket_is_ignored(socket_folder):
    os.mkdir(os.path.join(domain_folder(7), "1.0123abcd"))
    session = open_session(7)
    assert os.path.exists(own_socket(domain_folder(7), session.zid).path)
    session.close()
