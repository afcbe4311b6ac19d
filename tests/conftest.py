"""Shared by all tests: the embedded runtime answers to the ROS names, and no user setting leaks in."""

import atexit
import itertools
import os
import shutil
import tempfile
from collections.abc import Iterator

import pytest
from bot_console.runtime.importer import install
from hypothesis import settings

install()

_sockets = tempfile.mkdtemp(prefix="bc-", dir="/tmp")
_folders = itertools.count(1)
os.environ["BOT_CONSOLE_SOCKET_DIR"] = os.path.join(_sockets, "0")
atexit.register(shutil.rmtree, _sockets, ignore_errors=True)

# The default run tries the same examples each time, so that red means a change: HYPOTHESIS_PROFILE=explore tries more.
settings.register_profile("repeatable", derandomize=True, deadline=None, database=None)
settings.register_profile("explore", deadline=None, max_examples=1000)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "repeatable"))


@pytest.fixture(autouse=True)
def socket_folder(monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    """A folder of the test's own in which its processes meet: none joins a system that runs on this machine.

    Its path is short, as that of a socket must be, and it is made by who joins first.
    """
    name = os.path.join(_sockets, f"{next(_folders):x}")
    monkeypatch.setenv("BOT_CONSOLE_SOCKET_DIR", name)
    yield name
    shutil.rmtree(name, ignore_errors=True)


def pytest_xdist_auto_num_workers() -> int:
    """One more than there are processors for `-n auto`: the tests of the screen wait for it to come to rest."""
    return (os.cpu_count() or 1) + 1
