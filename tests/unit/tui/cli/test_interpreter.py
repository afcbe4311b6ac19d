"""How the interpreter is set while a screen is made and shown."""

from __future__ import annotations

import gc
import sys

import pytest
from bot_console.tui.cli import main, screen
from bot_console.tui.cli.interpreter import (
    SWITCH_INTERVAL,
    collect_from_now_on,
    eager_switching,
    without_collector,
)


def test_no_garbage_is_searched_for_until_all_is_there_and_none_among_that() -> None:
    class There:
        pass

    try:
        with without_collector():
            assert not gc.isenabled()
            there = There()
            collect_from_now_on()
            assert gc.isenabled()
            assert not any(each is there for each in gc.get_objects()), "it is looked through no more"
    finally:
        gc.unfreeze()


def test_an_end_before_all_is_there_does_not_look_through_what_was_made() -> None:
    class There:
        pass

    try:
        with without_collector():
            there = There()
        assert gc.isenabled()
        assert not any(each is there for each in gc.get_objects())
    finally:
        gc.unfreeze()


def test_a_start_that_fails_leaves_the_collector_at_work() -> None:
    with pytest.raises(ZeroDivisionError), without_collector():
        raise ZeroDivisionError
    assert gc.isenabled()


def test_a_console_is_started_without_the_collector(monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[bool] = []

    def run(options: object) -> int:
        seen.append(gc.isenabled())
        return 0

    monkeypatch.setattr(screen, "run", run)
    assert main.main([]) == 0 and seen == [False] and gc.isenabled()


def test_threads_are_switched_eagerly_only_while_there_is_a_screen() -> None:
    before = sys.getswitchinterval()
    with eager_switching():
        assert sys.getswitchinterval() == pytest.approx(SWITCH_INTERVAL)
    assert sys.getswitchinterval() == before
