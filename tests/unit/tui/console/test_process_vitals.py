"""CPU and memory usage of a process, measured from time to time."""

from __future__ import annotations

import os

import pytest
from bot_console.tui.console.launch.vitals import FROZEN, HANGS, Usage
from bot_console.tui.session.embedded.vitals import SystemVitals


class FakeVitals:
    """Vitals that are set by the test."""

    def __init__(self) -> None:
        self.seconds: float | None = 0.0
        self.wanted: float | None = None
        self.stopped = False
        self.held = ""
        self.line: str | None = None
        self.bytes: int | None = 20_400_000

    def cpu_seconds(self) -> float | None:
        return self.seconds

    def wanted_seconds(self) -> float | None:
        return self.wanted

    def memory_bytes(self) -> int | None:
        return self.bytes

    def is_stopped(self) -> bool:
        return self.stopped

    def line_in_debugger(self) -> str | None:
        return self.line

    def holds_lock_in(self) -> str:
        return self.held

    def hangs_in(self) -> str:
        return ""


def test_cpu_usage_is_measured_over_each_second() -> None:
    reported = FakeVitals()
    usage = Usage(reported, 0.0)
    reported.seconds = 0.5
    usage.poll(0.9)
    assert (usage.share, usage.memory) == (None, None)
    usage.poll(1.0)
    assert (usage.share, usage.memory) == (0.5, 20)
    reported.seconds, reported.bytes = 3.5, 1_231_000_000
    usage.poll(3.0)
    assert (usage.share, usage.memory) == (1.5, 1230)


def test_usage_stays_while_it_differs_by_one_percent_only() -> None:
    reported = FakeVitals()
    usage, shown, used = Usage(reported, 0.0), [], 0.0
    for second, share in enumerate((0.03, 0.04, 0.02, 0.05, 0.04, 0.0), 1):
        used += share
        reported.seconds = used
        usage.poll(float(second))
        shown.append(usage.share)
    assert shown == [0.03, 0.03, 0.03, 0.05, 0.05, 0.0]


def test_all_processes_are_measured_at_the_same_moments() -> None:
    usages = [Usage(FakeVitals(), begun) for begun in (0.1, 0.4, 0.8)]
    for each in usages:
        each.poll(0.95)
    assert [each.share for each in usages] == [None, None, None]
    for each in usages:
        each.poll(1.05)
    assert [each.share for each in usages] == [0.0, 0.0, None]  # a quarter of a second is too short for a result
    for each in usages:
        each.poll(2.05)
    assert [each.share for each in usages] == [0.0, 0.0, 0.0]


def test_time_without_waiting_is_measured() -> None:
    reported = FakeVitals()
    usage = Usage(reported, 0.0)
    for second, used in enumerate((0.95, 1.9, 2.0, 3.0), 1):
        reported.seconds = used
        usage.poll(float(second))
    assert usage.busy_s == 1.0


def test_a_process_waiting_for_a_busy_cpu_counts_as_not_waiting() -> None:
    reported = FakeVitals()
    reported.wanted = 5.0
    usage = Usage(reported, 0.0)
    for second, wanted in enumerate((6.0, 7.0, 7.2, 8.2), 1):
        reported.seconds, reported.wanted = 0.1 * second, wanted
        usage.poll(float(second))
    assert (usage.share, usage.busy_s) == (0.1, 1.0)


def test_a_frozen_process_is_noticed_within_half_a_second() -> None:
    reported = FakeVitals()
    usage = Usage(reported, 0.0)
    reported.stopped = True
    usage.poll(0.4)
    assert not usage.stall_reason
    usage.poll(0.5)
    assert usage.stall_reason == FROZEN
    reported.stopped = False
    usage.poll(1.0)
    assert not usage.stall_reason


@pytest.mark.parametrize(
    ("line", "shown"), [("n.py:7, in tick", "stopped in debugger at n.py:7, in tick"), ("", "stopped in debugger")]
)
def test_a_process_at_a_breakpoint_is_shown_as_stopped_in_debugger(line: str, shown: str) -> None:
    reported = FakeVitals()
    usage = Usage(reported, 0.0)
    reported.line = line
    usage.poll(0.5)
    assert usage.stall_reason == shown
    reported.line = None
    usage.poll(1.0)
    assert not usage.stall_reason


def test_a_held_interpreter_lock_is_reported_with_the_line() -> None:
    reported = FakeVitals()
    usage = Usage(reported, 0.0)
    reported.held = "holds.py:12, in tick"
    usage.poll(0.5)
    assert usage.stall_reason.startswith(f"{HANGS} holds.py:12, in tick")
    reported.held = ""
    usage.poll(1.0)
    assert not usage.stall_reason


def test_unavailable_vitals_are_unknown() -> None:
    reported = FakeVitals()
    usage = Usage(reported, 0.0)
    reported.seconds = reported.bytes = None
    usage.poll(1.0)
    assert (usage.share, usage.memory, usage.busy_s) == (None, None, 0.0)


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="needs /proc")
def test_vitals_exist_for_this_process_but_not_for_a_dead_one() -> None:
    vitals = SystemVitals(os.getpid())
    assert (vitals.memory_bytes() or 0) > 5_000_000 and (vitals.cpu_seconds() or 0.0) > 0.0
    assert SystemVitals(1 << 22).memory_bytes() is None
