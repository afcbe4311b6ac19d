"""A limit of open files, or of the address space, that is too low for a console is raised, or reported."""

from __future__ import annotations

import sys

import pytest

if sys.platform == "win32":
    pytest.skip("there are no such limits", allow_module_level=True)

import resource

from bot_console.tui.cli.screen import too_few_files, too_little_address_space

NO_LIMIT = resource.RLIM_INFINITY
FEW_FILES = "bot-console needs 256 open files, and at most 200 are allowed here: see `ulimit -Hn`"
LITTLE_SPACE = (
    "bot-console needs an address space of 1,500,000 KiB, and at most 1,400,000 are allowed here: see `ulimit -Hv`; "
    "`bot-console stop` needs less"
)


@pytest.fixture
def limits(monkeypatch: pytest.MonkeyPatch) -> dict[int, tuple[int, int]]:
    """The limits of this process, in place of the real ones."""
    known: dict[int, tuple[int, int]] = {}
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
    limits: dict[int, tuple[int, int]], before: tuple[int, int], message: str, after: int
) -> None:
    limits[resource.RLIMIT_NOFILE] = before
    assert too_few_files() == message
    assert limits[resource.RLIMIT_NOFILE] == (after, before[1])


@pytest.mark.parametrize(
    ("before", "message", "after"),
    [
        ((NO_LIMIT, NO_LIMIT), "", NO_LIMIT),
        ((2_000_000, 3_000_000), "", 2_000_000),
        ((1_000_000, 3_000_000), "", 1_500_000),
        ((1_000_000, 1_400_000), LITTLE_SPACE, 1_000_000),
    ],
)
def test_low_limit_of_the_address_space_is_raised_or_reported(
    limits: dict[int, tuple[int, int]], before: tuple[int, int], message: str, after: int
) -> None:
    soft, hard = (each if each == NO_LIMIT else each * 1024 for each in before)
    limits[resource.RLIMIT_AS] = soft, hard
    assert too_little_address_space() == message
    assert limits[resource.RLIMIT_AS] == (after if after == NO_LIMIT else after * 1024, hard)
