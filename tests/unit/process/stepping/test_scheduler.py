"""The scheduler alone: a wait may jump in time only if nothing can happen before its end."""

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


def test_single_wait_jumps_to_its_end() -> None:
    scheduler = Scheduler(0)
    assert not scheduler.wait(scheduler.driver_task(), None, DUE)
    assert scheduler.now == DUE


def test_time_waits_for_a_blocking_start_even_if_nobody_else_is_ready() -> None:
    scheduler = Scheduler(0)
    driver = scheduler.driver_task()
    scheduler.starting.add(ScheduledTask(scheduler, 1, None))
    thread = wait_in_a_thread(scheduler, driver)
    assert (scheduler.now, scheduler.holder) == (0, None)
    scheduler.stop_waiting_for_starts()
    thread.join()
    assert scheduler.now == DUE


def test_detached_thread_does_not_move_the_time_of_the_running_one() -> None:
    scheduler = Scheduler(0)
    driver = scheduler.driver_task()
    scheduler.holder = other = ScheduledTask(scheduler, 1, None)
    driver.detached = True
    thread = wait_in_a_thread(scheduler, driver)
    assert (scheduler.now, scheduler.holder) == (0, other)
    scheduler.leave(other)
    thread.join()
    assert scheduler.now == DUE


def test_task_woken_before_its_wait_begins_waits_no_time() -> None:
    scheduler = Scheduler(0)
    called: Any = SimpleNamespace(called=True)
    scheduler.holder = task = scheduler.tasks[LAST] = ScheduledTask(scheduler, LAST, called)
    assert not scheduler.wait(task, None, DUE)
    assert scheduler.now == 0
