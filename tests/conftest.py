"""Fixtures and hooks for all tests: the ROS names mean the embedded runtime, and no user setting leaks in."""

import atexit
import gc
import itertools
import os
import re
import shutil
import signal
import sys
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest
from bot_console.runtime.importer import install
from bot_console.tui.session.machine import console_needs
from hypothesis import settings
from hypothesis.internal.conjecture import providers
from package_under_test import difference

pytest_plugins = ["second_tries"]

TESTS = Path(__file__).absolute().parent

ON_ROS = os.environ.get("BOT_CONSOLE_TESTS_ON") == "ros"
"""Whether the ROS names mean the packages of the machine, as `-m ros` needs."""

if ON_ROS:
    console_needs.provide_missing()
else:
    install()
    for variable in ("ROS_DOMAIN_ID", "ROS_AUTOMATIC_DISCOVERY_RANGE"):
        os.environ.pop(variable, None)

# A shell that starts the tests in the background ignores these signals, and every program of a test would inherit that.
for number in (signal.SIGINT, *(getattr(signal, name) for name in ("SIGQUIT", "SIGHUP") if hasattr(signal, name))):
    if signal.getsignal(number) is signal.SIG_IGN:
        signal.signal(number, signal.default_int_handler if number is signal.SIGINT else signal.SIG_DFL)

gc.set_threshold(50_000, 20, 50)  # most objects are gone by then; saves a sixth of pytest's collection

_sockets = tempfile.mkdtemp(prefix="bc-", dir="/tmp")
_folders = itertools.count(1)
os.environ["BOT_CONSOLE_SOCKET_DIR"] = os.path.join(_sockets, "0")
os.environ["BOT_CONSOLE_USER_DIR"] = os.path.join(_sockets, "0-user")
atexit.register(shutil.rmtree, _sockets, ignore_errors=True)

# Workers and programs of tests use the byte code that pip or an earlier run has compiled, even if the environment says
# that none is to be kept: compiling everything takes each worker as long as the rest of its start.
if os.environ.pop("PYTHONDONTWRITEBYTECODE", None):
    sys.dont_write_bytecode = False

# The default run tries the same few examples each time, so that a failure means a change: HYPOTHESIS_PROFILE=explore
# tries many others.
settings.register_profile("repeatable", derandomize=True, deadline=None, database=None, max_examples=25)
settings.register_profile("explore", deadline=None, max_examples=1000)
PROFILE = os.environ.get("HYPOTHESIS_PROFILE", "repeatable")
settings.load_profile(PROFILE)
if PROFILE == "repeatable":
    # It would read all our sources for constants to try: that takes a quarter of the time in which a worker collects
    # the tests, and gives other examples after each change.
    providers.is_local_module_file = lambda path: False


@pytest.fixture(autouse=True)
def socket_folder(monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    """A separate socket folder for the test, so that none of its processes joins a system that runs on this machine.

    Its path is short, as a socket's must be. The first process to join creates it.
    """
    name = os.path.join(_sockets, f"{next(_folders):x}")
    monkeypatch.setenv("BOT_CONSOLE_SOCKET_DIR", name)
    monkeypatch.setenv("BOT_CONSOLE_USER_DIR", f"{name}-user")
    yield name
    for made in (name, f"{name}-user"):
        if os.path.lexists(made):
            shutil.rmtree(made, ignore_errors=True)


@pytest.fixture
def tmp_path(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A separate folder for the test, like pytest's own fixture, which lists all earlier folders to find the next
    number.

    Its path is no longer than pytest's, since some tests put sockets into it.
    """
    name = re.sub(r"\W", "_", request.node.name)[:26]
    return tmp_path_factory.mktemp(f"{name}{next(_folders)}", numbered=False)


@pytest.fixture(autouse=True)
def leaves_no_session(socket_folder: str) -> Iterator[None]:
    """Close the sessions that a test opened in this process: the next test would share them otherwise.

    A command in a stepped system opens one, too.
    """
    before = _shares_domains()
    yield
    if _shares_domains() and not before:
        from bot_console.runtime.children.child_discovery import let_children_meet
        from bot_console.runtime.rmw.local import local_bus
        from bot_console.runtime.rmw.middleware import choose_middleware
        from bot_console.runtime.rmw.zenoh.domain.domain_bus import close_shared_buses
        from bot_console.runtime.stop_file_path import STOP_FILE_VARIABLE

        close_shared_buses()
        choose_middleware(local_bus)
        let_children_meet(False)
        os.environ.pop(STOP_FILE_VARIABLE, None)


def _shares_domains() -> bool:
    """Whether contexts of this process share or have shared a domain with others; imports nothing that is unused."""
    chosen, shared = (
        sys.modules.get(f"bot_console.runtime.rmw.{name}") for name in ("middleware", "zenoh.domain.domain_bus")
    )
    return chosen is not None and shared is not None and bool(shared._buses or chosen.is_chosen(shared.shared_bus))


def pytest_configure(config: pytest.Config) -> None:
    """Refuse to test any other source than this one.

    Each worker begins to read the tests at a different file: what it compiles, the others find compiled.
    """
    worker = getattr(config, "workerinput", None)
    if worker is None and (different := difference(Path(console_needs.__file__).parents[3], TESTS.parent)):
        raise pytest.UsageError(different)
    if worker is not None and [Path(each).absolute() for each in config.args] == [TESTS]:
        files = sorted(TESTS.rglob("test_*.py"))
        first = len(files) * int(worker["workerid"].removeprefix("gw")) // worker["workercount"]
        config.args = [str(each) for each in (*files[first:], *files[:first])]


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Iterator[None]:
    """Freeze everything imported and collected: traversing it took a quarter of the time of a test with a screen."""
    gc.disable()
    try:
        return (yield)
    finally:
        gc.freeze()
        gc.enable()


def pytest_unconfigure() -> None:
    """Freeze what the tests left behind, since pytest ends with five full garbage collections."""
    gc.freeze()


@pytest.fixture
def notices() -> Iterator[list[str]]:
    """The messages of the runtime about its programs, in order."""
    from bot_console.runtime.process import on_notice

    reported: list[str] = []
    forget = on_notice(lambda process, text: reported.append(text))
    yield reported
    forget()


def pytest_xdist_auto_num_workers() -> int:
    """Two workers per processor for `-n auto`: a worker waits half of its time for a program, a screen or another
    thread."""
    return 2 * (os.cpu_count() or 1)


WAITING = ("acceptance", "contract")
"""Folders whose tests mostly wait for other programs."""
COMPUTING = ("pilot", "project", "property", "snapshot")
"""Folders whose tests mostly compute."""


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Order the tests independently of how they were read.

    Files that wait and files that compute alternate: workers that all wait at the same time leave processors idle, and
    many programs that start at the same time delay each other.
    """
    turns = _turns(sorted({each.path for each in items}))
    items.sort(key=lambda each: turns[each.path])


def _turns(files: Sequence[Path]) -> dict[Path, tuple[float, Path]]:
    """The sort key of each file: files of both kinds begin and end together, and all others follow."""
    folders = {each: each.relative_to(TESTS).parts[0] if each.is_relative_to(TESTS) else "" for each in files}
    turns = {each: (1.0, each) for each in files}
    for kind in (WAITING, COMPUTING):
        those = [each for each in files if folders[each] in kind]
        turns |= {each: (index / len(those), each) for index, each in enumerate(those)}
    return turns
