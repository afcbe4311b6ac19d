"""Interpreter settings while a screen is made and shown."""

from __future__ import annotations

import gc
import sys

import pytest
from bot_console.tui.cli import main, open_console
from bot_console.tui.cli.interpreter import (
    SWITCH_INTERVAL_S,
    eager_switching,
    resume_collection,
    without_collector,
)


def test_garbage_is_not_collected_until_start_is_complete() -> None:
    class There:
        pass

    try:
        with without_collector():
            assert not gc.isenabled()
            there = There()
            resume_collection()
            assert gc.isenabled()
            assert not any(each is there for each in gc.get_objects()), "it is no longer traversed"
    finally:
        gc.unfreeze()


def test_early_exit_hides_created_objects_from_the_collector() -> None:
    class There:
        pass

    try:
        with without_collector():
            there = There()
        assert gc.isenabled()
        assert not any(each is there for each in gc.get_objects())
    finally:
        gc.unfreeze()


def test_failed_start_leaves_collector_enabled() -> None:
    with pytest.raises(ZeroDivisionError), without_collector():
        raise ZeroDivisionError
    assert gc.isenabled()


def test_console_starts_without_the_collector(monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[bool] = []

    def run(options: object) -> int:
        seen.append(gc.isenabled())
        return 0

    monkeypatch.setattr(open_console, "run", run)
    assert main.main([]) == 0 and seen == [False] and gc.isenabled()


def test_threads_switch_eagerly_only_while_a_screen_is_shown() -> None:
    before = sys.getswitchinterval()
    with eager_switching():
        assert sys.getswitchinterval() == pytest.approx(SWITCH_INTERVAL_S)
    assert sys.getswitchinterval() == before
