"""The scheduler by itself: when a wait may jump in time, because nothing comes before its end."""

from __future__ import annotations

import threading
from types import SimpleNamespace
from typing import Any

from bot_console.runtime.process.stepping.scheduler import LAST, ScheduledTask, Scheduler

DUE = 10


def wait_in_a_thread(scheduler: Scheduler, task: ScheduledTask) -> threading.Thread:
    thread = threading.Thread(target=scheduler.wait, args=(task, None, DUE))
    thread.start()
    while thread.is_alive() and not task.waiting:
        pass
    return thread


def test_a_lone_wait_jumps_to_its_end() -> None:
    scheduler = Scheduler(0)
    assert not scheduler.wait(scheduler.driver_task(), None, DUE)
    assert scheduler.now == DUE


def test_time_waits_for_a_start_that_blocks_also_where_nobody_else_is_ready() -> None:
    scheduler = Scheduler(0)
    driver = scheduler.driver_task()
    scheduler.starting.add(ScheduledTask(scheduler, 1, None))
    thread = wait_in_a_thread(scheduler, driver)
    assert (scheduler.now, scheduler.holder) == (0, None)
    scheduler.stop_waiting_for_starts()
    thread.join()
    assert scheduler.now == DUE


def test_a_thread_that_was_taken_for_hanging_moves_no_time_of_the_running_thread() -> None:
    scheduler = Scheduler(0)
    driver = scheduler.driver_task()
    scheduler.holder = other = ScheduledTask(scheduler, 1, None)
    driver.detached = True
    thread = wait_in_a_thread(scheduler, driver)
    assert (scheduler.now, scheduler.holder) == (0, other)
    scheduler.leave(other)
    thread.join()
    assert scheduler.now == DUE


def test_who_is_called_between_the_beginning_of_a_wait_and_its_entry_waits_no_time() -> None:
    scheduler = Scheduler(0)
    called: Any = SimpleNamespace(called=True)
    scheduler.holder = task = scheduler.tasks[LAST] = ScheduledTask(scheduler, LAST, called)
    assert not scheduler.wait(task, None, DUE)
    assert scheduler.now == 0
