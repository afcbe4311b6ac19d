"""Whether a thread is blocked is judged by the operating system's statistics, not by elapsed time."""

from __future__ import annotations

import pytest
from bot_console.runtime.process.watch import thread_work
from bot_console.runtime.process.watch.thread_work import CHECKS_PER_STALL, IMPORTING, SLOW_DISK_FACTOR, ThreadWork

FUTEX = "futex_do_wait"


class Machine:
    """The operating system's statistics of one thread, set by a test."""

    def __init__(self, patch):
        self.state, self.seconds, self.switches, self.place = "S", 0.0, 0, FUTEX
        self.importing = False
        self.children = {}
        patch.setattr(thread_work, "state_and_seconds", self.reported)
        patch.setattr(thread_work, "_read", self.read)
        patch.setattr(thread_work.stack_frames, "is_importing", lambda ident: self.importing)
        self.work = ThreadWork(7, 7)

    def reported(self, task):
        return self.children.get(task, (self.state, self.seconds))

    def read(self, path):
        if path.endswith("children"):
            return " ".join(self.children) if "/7/" in path else ""
        return self.place if path.endswith("wchan") else f"x\nvoluntary_ctxt_switches:{self.switches}"

    def poll(self, times, *, seconds=0.0, switches=0):
        for _ in range(times):
            self.work.poll()
            self.seconds += seconds
            self.switches += switches
        return self.work


@pytest.fixture
def machine(monkeypatch):
    return Machine(monkeypatch)


@pytest.mark.parametrize("state", ["R", "D"])
def test_thread_without_processor_or_disk_is_not_blocked(machine, state):
    machine.state = state
    work = machine.poll(1000)
    assert not work.is_blocked() and not work.is_busy(1.0)


def test_thread_waiting_for_the_interpreter_is_not_blocked(machine):
    assert not machine.poll(1000, switches=50).is_blocked()


def test_lock_that_is_never_released_blocks(machine):
    assert not machine.poll(CHECKS_PER_STALL).is_blocked()
    assert machine.poll(1).is_blocked()


def test_thread_polling_a_device_is_blocked(machine):
    machine.place = "do_select"
    assert machine.poll(CHECKS_PER_STALL, switches=2).is_blocked()


def test_only_sleep_without_wakeups_counts_if_the_system_hides_the_place(machine):
    machine.place = "0"
    assert not machine.poll(1000, switches=2).is_blocked()
    assert machine.poll(CHECKS_PER_STALL + 1).is_blocked()


def test_import_from_a_slow_disk_gets_more_time(machine):
    machine.place, machine.importing = "request_wait_answer", True
    assert not machine.poll(CHECKS_PER_STALL * SLOW_DISK_FACTOR).is_blocked()
    assert machine.poll(1).is_blocked()


def test_child_process_that_makes_progress_is_waited_for(machine):
    machine.place = "do_wait"
    machine.children = {"99": ("S", 0.0)}
    for _ in range(100):
        machine.children["99"] = ("S", machine.children["99"][1] + 0.01)
        assert not machine.poll(1).is_blocked()
    machine.children["99"] = ("R", machine.children["99"][1])
    assert not machine.poll(100).is_blocked()
    machine.children["99"] = ("S", machine.children["99"][1])
    assert machine.poll(CHECKS_PER_STALL + 1).is_blocked()


def test_long_computation_is_busy_and_an_import_only_after_longer(machine):
    machine.state = "R"
    assert not machine.poll(10, seconds=1.0).is_busy(1.0)
    assert machine.poll(1).is_busy(1.0)
    assert not machine.work.is_busy(1.0, stalls=2)
    other = machine.work = ThreadWork(7, 7)
    machine.importing = True
    assert not machine.poll(IMPORTING, seconds=1.0).is_busy(1.0)
    assert machine.poll(1).is_busy(1.0) and other is machine.work


def test_system_without_statistics_gets_the_longest_timeout(monkeypatch):
    monkeypatch.setattr(thread_work, "state_and_seconds", lambda task: None)
    monkeypatch.setattr(thread_work.time, "process_time", lambda: 1.0)
    work = ThreadWork(7, 7)
    for _ in range(CHECKS_PER_STALL * SLOW_DISK_FACTOR):
        work.poll()
    assert not work.is_blocked()
    for _ in range(CHECKS_PER_STALL * SLOW_DISK_FACTOR):
        work.poll()
    assert work.is_blocked()
