"""A node process ends as a Python process does, and can be stopped like one."""

from __future__ import annotations

import gc
import queue
import sys
import threading
import time
import weakref
from concurrent.futures import ThreadPoolExecutor

import pytest
from bot_console.runtime.process import (
    MAIN,
    NodeProcess,
    ProcessLocal,
    ProcessState,
    RealTime,
    current,
    on_notice,
    running_as,
)
from bot_console.runtime.process.node import node_process as node_process_module

LONG = 240.0


def exit_with(code):
    return lambda: sys.exit(code)


def fail():
    raise ValueError("broken wheel")


def interrupt_self():
    raise KeyboardInterrupt


@pytest.mark.parametrize(
    ("target", "code", "last_line"),
    [
        (lambda: None, 0, ""),
        (lambda: 7, 0, ""),
        (exit_with(None), 0, ""),
        (exit_with(3), 3, ""),
        (exit_with(True), 1, ""),
        (exit_with(256 + 2), 2, ""),
        (exit_with(-1), 255, ""),
        (exit_with("no wheels"), 1, "no wheels\n"),
        (fail, 1, "ValueError: broken wheel\n"),
        (interrupt_self, -2, "KeyboardInterrupt\n"),
    ],
)
def test_exit_code_follows_from_how_the_target_ends(run, target, code, last_line):
    ended = run(target)
    assert ended.process.exit_code == code
    assert ended.process.state is ProcessState.EXITED
    assert (ended.err[-1] if ended.err else "") == last_line


def test_traceback_begins_in_user_code(run):
    lines = run(fail).stderr.splitlines()
    assert lines[0] == "Traceback (most recent call last):"
    assert lines[1].startswith(f'  File "{__file__}", line ')
    assert lines[1].endswith(", in fail")
    assert lines[-1] == "ValueError: broken wheel"


def test_each_process_has_its_own_pid_and_locals(run):
    seen = []
    counter = ProcessLocal(list)

    def target():
        counter.get().append(current().name)
        seen.append((current().pid, counter.get()))

    run(target, name="a")
    run(target, name="b")
    assert seen[0][0] != seen[1][0]
    assert [names for _pid, names in seen] == [["a"], ["b"]]
    assert counter.get() == []


def test_threads_outside_node_processes_belong_to_main():
    assert current() is MAIN
    assert MAIN.is_alive


def test_process_starts_only_once(run):
    process = run(lambda: None).process
    with pytest.raises(RuntimeError, match="already started"):
        process.start(lambda: None)


BLOCKED_IN = {
    "time.sleep": lambda: time.sleep(1000),
    "Event.wait": lambda: threading.Event().wait(),
    "Event.wait with timeout": lambda: threading.Event().wait(1000),
    "Queue.get": lambda: queue.Queue().get(),
    "SimpleQueue.get": lambda: queue.SimpleQueue().get(),
    "Semaphore.acquire": lambda: threading.Semaphore(0).acquire(),
    "Wakeup.wait": lambda: current().clock.wakeup().wait(),
    "sleep_until": lambda: current().clock.sleep_until(current().clock.steady_ns() + 10**12),
    "Thread.join": lambda: start_sleeper().join(),
}


def start_sleeper():
    thread = threading.Thread(target=time.sleep, args=(1000,), daemon=True)
    thread.start()
    return thread


@pytest.mark.parametrize("block", BLOCKED_IN.values(), ids=BLOCKED_IN.keys())
def test_interrupt_wakes_any_blocking_call(start, block):
    def target():
        print("ready")
        block()

    started = start(target)
    started.until_printed("ready")
    started.process.interrupt()
    assert started.end() == -2
    assert started.err[-1] == "KeyboardInterrupt\n"


def test_interrupt_is_delivered_once(start):
    def target():
        print("ready")
        try:
            time.sleep(1000)
        except KeyboardInterrupt:
            print("caught")
        current().clock.wakeup().wait(current().clock.steady_ns() + 1)
        print("went on")

    started = start(target)
    started.until_printed("ready")
    started.process.interrupt()
    assert started.end() == 0
    assert started.stdout == "ready\ncaught\nwent on\n"


def spin_for_ever():
    print("ready")
    while True:
        pass


def test_interrupt_reaches_a_busy_loop(start):
    started = start(spin_for_ever)
    started.until_printed("ready")
    started.process.interrupt()
    assert started.end() == -2


def test_sigterm_without_handler_ends_the_process_silently(start):
    def target():
        print("ready")
        try:
            time.sleep(1000)
        finally:
            print("never seen")

    started = start(target)
    started.until_printed("ready")
    started.process.terminate()
    assert started.end() == -15
    assert (started.stdout, started.stderr) == ("ready\n", "")


def test_interrupt_hooks_run_before_keyboard_interrupt_and_get_the_signal(start):
    seen = []

    def target():
        process = current()
        process.on_interrupt(lambda signum: seen.append((signum, current() is process)))
        print("ready")
        time.sleep(1000)

    started = start(target)
    started.until_printed("ready")
    started.process.terminate()
    assert started.process.is_alive
    started.process.interrupt()
    assert started.end() == -2
    assert seen == [(15, True), (2, True)]


def test_interrupt_hook_can_be_removed(start):
    seen = []

    def target():
        remove = current().on_interrupt(seen.append)
        remove()
        print("ready")
        time.sleep(1000)

    started = start(target)
    started.until_printed("ready")
    started.process.terminate()
    assert started.end() == -15
    assert seen == []


def test_exit_callbacks_run_newest_first_and_late_ones_at_once(start):
    order = []
    go = threading.Event()

    def target():
        current().on_exit(lambda p: order.append("first"))
        print("ready")
        go.wait()

    started = start(target)
    started.until_printed("ready")
    started.process.on_exit(lambda p: order.append("second"))
    never = started.process.on_exit(lambda p: order.append("never"))
    never()
    go.set()
    started.end()
    started.process.on_exit(lambda p: order.append(p.exit_code))
    assert order == ["second", "first", 0]


def test_exit_callback_runs_as_the_process_and_may_fail(start):
    notices = []
    remove = on_notice(lambda process, text: notices.append((process.name, text)))
    seen = []

    def target():
        current().on_exit(lambda p: seen.append(current().name))
        current().on_exit(lambda p: 1 / 0)

    try:
        assert start(target, name="n").end() == 0
    finally:
        remove()
    assert seen == ["n"]
    assert len(notices) == 1 and "division by zero" in notices[0][1]


def test_wait_times_out(start):
    started = start(lambda: time.sleep(1000))
    assert started.process.wait(0.0) is None
    assert started.process.is_alive


def test_kill_leaves_the_graph_before_the_process_ends(start):
    order = []

    def target():
        current().on_abandon(lambda: order.append("abandoned"))
        current().on_exit(lambda p: order.append(p.exit_code))
        print("ready")
        try:
            time.sleep(1000)
        finally:
            print("too late")

    started = start(target)
    started.until_printed("ready")
    started.process.kill()
    assert started.end() == -9
    assert order == ["abandoned", -9]
    assert started.stdout == "ready\n"
    started.process.main_state.thread.join(LONG)
    assert started.process.state is ProcessState.EXITED


def test_process_that_does_not_unwind_is_abandoned_and_its_line_reported(start, monkeypatch):
    monkeypatch.setattr(node_process_module, "KILL_TIMEOUT_S", 0.01)
    reported = threading.Event()
    notices = []

    def hook(process, text):
        notices.append((process.name, text))
        reported.set()

    stubborn_lock = threading.Lock()
    stubborn_lock.acquire()

    def target():
        print("ready")
        stubborn_lock.acquire()  # blocks here

    line = target.__code__.co_firstlineno + 2
    remove = on_notice(hook)
    started = start(target, name="stubborn")
    try:
        started.until_printed("ready")
        started.process.kill()
        assert started.end() == -9
        assert reported.wait(LONG)
    finally:
        remove()
        stubborn_lock.release()
    assert started.process.state is ProcessState.ABANDONED
    assert notices[0][0] == "stubborn"
    assert f"{__file__}:{line}, in target" in notices[0][1]


def test_stop_escalates_until_the_process_has_ended(start):
    def target():
        current().on_interrupt(lambda signum: None)
        print("ready")
        while True:
            try:
                time.sleep(1000)
            except KeyboardInterrupt:
                print("ignored")

    started = start(target)
    started.until_printed("ready")
    assert started.process.stop(grace=0.01) == -9
    assert "ignored\n" in started.out


def test_signals_after_the_end_are_ignored(run):
    process = run(lambda: None).process
    process.interrupt()
    process.terminate()
    process.kill()
    assert process.exit_code == 0


def test_many_processes_leave_no_thread(run):
    before = threading.active_count()
    for number in range(20):
        process = run(lambda: None, name=str(number)).process
        process.main_state.thread.join(LONG)
    assert threading.active_count() == before


@pytest.mark.slow
def test_ended_process_leaves_no_objects_behind(run):
    def target():
        start_sleeper()
        with ThreadPoolExecutor(1) as pool:
            pool.submit(print)

    started = run(target)
    reference = weakref.ref(started.process)
    thread = weakref.ref(started.process.main_state.thread)
    started.process.main_state.thread.join(LONG)
    started.process = None
    deadline = time.monotonic() + LONG
    while (thread() or reference()) and time.monotonic() < deadline:  # its daemon thread needs a moment to unwind
        threading.Event().wait(0.1)
        gc.collect()
    assert thread() is None
    assert reference() is None


def test_process_inherits_the_clock_of_its_creator():
    clock = RealTime()
    maker = NodeProcess("maker", clock)
    with running_as(maker):
        assert NodeProcess("made").clock is clock
