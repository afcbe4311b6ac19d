"""The scheduler by itself: when a wait may jump in time, because nothing comes before its end."""

from __future__ import annotations

import threading
from types import SimpleNamespace
from typing import Any

from bot_console.runtime.process.stepping.baton import LAST, Baton, Seat

DUE = 10


def wait_in_a_thread(baton: Baton, seat: Seat) -> threading.Thread:
    thread = threading.Thread(target=baton.wait, args=(seat, None, DUE))
    thread.start()
    while thread.is_alive() and not seat.waiting:
        pass
    return thread


def test_a_lone_wait_jumps_to_its_end() -> None:
    baton = Baton(0)
    assert not baton.wait(baton.driver_seat(), None, DUE)
    assert baton.now == DUE


def test_time_waits_for_a_start_that_blocks_also_where_nobody_else_is_ready() -> None:
    baton = Baton(0)
    driver = baton.driver_seat()
    baton.starting.add(Seat(baton, 1, None))
    thread = wait_in_a_thread(baton, driver)
    assert (baton.now, baton.holder) == (0, None)
    baton.stop_waiting_for_starts()
    thread.join()
    assert baton.now == DUE


def test_a_thread_that_was_taken_for_hanging_moves_no_time_of_who_has_the_baton() -> None:
    baton = Baton(0)
    driver = baton.driver_seat()
    baton.holder = other = Seat(baton, 1, None)
    driver.detached = True
    thread = wait_in_a_thread(baton, driver)
    assert (baton.now, baton.holder) == (0, other)
    baton.leave(other)
    thread.join()
    assert baton.now == DUE


def test_who_is_called_between_the_beginning_of_a_wait_and_its_entry_waits_no_time() -> None:
    baton = Baton(0)
    called: Any = SimpleNamespace(called=True)
    baton.holder = seat = baton.seats[LAST] = Seat(baton, LAST, called)
    assert not baton.wait(seat, None, DUE)
    assert baton.now == 0
