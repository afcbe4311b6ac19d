"""A limit of this machine that is too low for a program is raised, or reported in one line."""

from __future__ import annotations

import sys

import pytest

if sys.platform == "win32":
    pytest.skip("needs the resource limits of POSIX", allow_module_level=True)

import resource

from bot_console.tui.cli.machine_limits import (
    no_node_here,
    no_robot_here,
    too_few_files,
    too_little_address_space,
    too_small_files,
)
from bot_console.tui.cli.main import main
from bot_console.tui.cli.verbs import stop as stopping

NO_LIMIT = resource.RLIM_INFINITY
FEW_FILES = "bot-console needs 256 open files, and at most 200 are allowed here: see `ulimit -Hn`"
LITTLE_SPACE = (
    "bot-console needs an address space of 500,000 KiB, and at most 400,000 are allowed here: see `ulimit -Hv`; "
    "`bot-console stop` needs less"
)
SMALL_FILES = "bot-console needs files of 64 KiB to start a robot, and at most 0 KiB are allowed here: see `ulimit -Hf`"
LITTLE_SPACE_FOR_NODES = LITTLE_SPACE.replace("500,000", "150,000").replace("400,000", "100,000")
Limits = dict[int, tuple[int, int]]


@pytest.fixture
def limits(monkeypatch: pytest.MonkeyPatch) -> Limits:
    """Limits of this process that replace the real ones."""
    known = dict.fromkeys((resource.RLIMIT_NOFILE, resource.RLIMIT_AS, resource.RLIMIT_FSIZE), (NO_LIMIT, NO_LIMIT))
    monkeypatch.setattr(resource, "getrlimit", known.__getitem__)
    monkeypatch.setattr(resource, "setrlimit", known.__setitem__)
    return known


@pytest.mark.parametrize(
    ("before", "message", "after"),
    [
        ((300, 300), "", 300),
        ((NO_LIMIT, NO_LIMIT), "", NO_LIMIT),
        ((64, NO_LIMIT), "", 256),
        ((64, 300), "", 256),
        ((64, 200), FEW_FILES, 64),
    ],
)
def test_low_limit_of_open_files_is_raised_or_reported(
    limits: Limits, before: tuple[int, int], message: str, after: int
) -> None:
    limits[resource.RLIMIT_NOFILE] = before
    assert too_few_files() == message
    assert limits[resource.RLIMIT_NOFILE] == (after, before[1])


@pytest.mark.parametrize(
    ("before", "message", "after"),
    [
        ((NO_LIMIT, NO_LIMIT), "", NO_LIMIT),
        ((2_000_000, 3_000_000), "", 2_000_000),
        ((300_000, 3_000_000), "", 500_000),
        ((300_000, 400_000), LITTLE_SPACE, 300_000),
    ],
)
def test_low_limit_of_the_address_space_is_raised_or_reported(
    limits: Limits, before: tuple[int, int], message: str, after: int
) -> None:
    soft, hard = (_bytes(each) for each in before)
    limits[resource.RLIMIT_AS] = soft, hard
    assert too_little_address_space() == no_robot_here() == message
    assert limits[resource.RLIMIT_AS] == (_bytes(after), hard)


@pytest.mark.parametrize(
    ("before", "message", "after"),
    [((NO_LIMIT, NO_LIMIT), "", NO_LIMIT), ((0, 1000), "", 64), ((0, 0), SMALL_FILES, 0), ((64, 64), "", 64)],
)
def test_low_limit_of_the_size_of_files_is_raised_or_reported(
    limits: Limits, before: tuple[int, int], message: str, after: int
) -> None:
    soft, hard = (_bytes(each) for each in before)
    limits[resource.RLIMIT_FSIZE] = soft, hard
    assert too_small_files() == no_robot_here() == message
    assert limits[resource.RLIMIT_FSIZE] == (_bytes(after), hard)


def test_node_needs_less_address_space_than_a_robot(limits: Limits) -> None:
    limits[resource.RLIMIT_AS] = _both(400_000)
    assert not no_node_here()
    limits[resource.RLIMIT_AS] = _both(100_000)
    assert no_node_here() == LITTLE_SPACE_FOR_NODES


@pytest.mark.parametrize(
    ("words", "limit", "kib", "message"),
    [
        (["--headless"], "RLIMIT_AS", 400_000, LITTLE_SPACE),
        (["--headless"], "RLIMIT_FSIZE", 0, SMALL_FILES),
        (["up"], "RLIMIT_AS", 400_000, LITTLE_SPACE),
        (["up"], "RLIMIT_FSIZE", 0, SMALL_FILES),
        (["run", "no_file.py"], "RLIMIT_AS", 100_000, LITTLE_SPACE_FOR_NODES),
        (["run", "--prefix", "nice", "no_file.py"], "RLIMIT_AS", 100_000, LITTLE_SPACE_FOR_NODES),
        (["launch", "no.launch.py"], "RLIMIT_AS", 100_000, LITTLE_SPACE_FOR_NODES),
        (["ros2", "launch", "no.launch.py"], "RLIMIT_AS", 100_000, LITTLE_SPACE_FOR_NODES),
    ],
)
def test_command_that_starts_nodes_refuses_before_it_starts_any(
    words: list[str], limit: str, kib: int, message: str, limits: Limits, capfd: pytest.CaptureFixture[str]
) -> None:
    limits[getattr(resource, limit)] = _both(kib)
    assert main(words) == 1
    assert capfd.readouterr() == ("", f"{message}\n")


@pytest.mark.parametrize(
    ("verb", "beginning"),
    [
        ("stop", "bot-console stop: no robot was stopped: there is too little memory"),
        ("release", "bot-console release: no robot was released: there is too little memory"),
    ],
)
def test_stop_that_does_not_fit_into_memory_says_that_it_stopped_nothing(
    verb: str, beginning: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def no_memory(*_: object) -> None:
        raise MemoryError

    monkeypatch.setattr(stopping, "reach_system", lambda: "")
    monkeypatch.setattr(stopping, "ReachedStop", no_memory)
    assert stopping.run(verb, []) == 1
    printed = capsys.readouterr().err
    assert printed.startswith(beginning) and len(printed.splitlines()) == 1


def _bytes(kib: int) -> int:
    return kib if kib == NO_LIMIT else kib * 1024


def _both(kib: int) -> tuple[int, int]:
    return _bytes(kib), _bytes(kib)
