"""Threads that a node starts belong to its process and end with it."""

from __future__ import annotations

import threading
from concurrent.futures import ThreadPoolExecutor

import pytest
from bot_console.runtime.process import current, unpatched

LONG = 240.0


def start_thread():
    thread = threading.Thread(target=lambda: print(current().name))
    thread.start()
    thread.join()


def start_timer():
    timer = threading.Timer(0.0, lambda: print(current().name))
    timer.start()
    timer.join()


def start_pool():
    with ThreadPoolExecutor(2) as pool:
        print(pool.submit(lambda: current().name).result())


def start_grandchild():
    outer = threading.Thread(target=start_thread)
    outer.start()
    outer.join()


@pytest.mark.parametrize("starter", [start_thread, start_timer, start_pool, start_grandchild])
def test_threads_inherit_the_process(run, starter):
    assert run(starter, name="mother").stdout == "mother\n"


def test_threads_of_main_stay_with_main(run):
    run(lambda: None)
    seen = []
    thread = threading.Thread(target=lambda: seen.append(current().name))
    thread.start()
    thread.join(LONG)
    assert seen == ["main"]


def test_process_waits_for_its_non_daemon_threads(start):
    release = threading.Event()

    def target():
        def child():
            release.wait()
            print("child done")

        threading.Thread(target=child).start()
        print("main done")

    started = start(target)
    started.until_printed("main done")
    assert started.process.is_alive
    release.set()
    assert started.end() == 0
    assert started.stdout == "main done\nchild done\n"


def test_interrupt_ends_the_wait_for_threads(start):
    def target():
        threading.Thread(target=threading.Event().wait).start()
        print("main done")

    started = start(target)
    started.until_printed("main done")
    started.process.interrupt()
    assert started.end() == 0
    assert "KeyboardInterrupt" in started.stderr


def test_daemon_threads_end_with_their_process(run):
    threads = []

    def target():
        thread = threading.Thread(target=threading.Event().wait, daemon=True)
        threads.append(thread)
        thread.start()

    assert run(target).process.exit_code == 0
    threads[0].join(LONG)
    assert not threads[0].is_alive()


def test_daemon_flag_is_as_requested(run):
    def target():
        def child():
            print(threading.current_thread().daemon, threading.Thread().daemon)

        for daemon in (False, True):
            thread = threading.Thread(target=child, daemon=daemon)
            thread.start()
            thread.join()
            print(thread.daemon)

    assert run(target).stdout == "False False\nFalse\nTrue True\nTrue\n"


def test_thread_lists_contain_only_the_own_process(start, run):
    release = threading.Event()
    start(release.wait, name="neighbour")

    def target():
        thread = threading.Thread(target=release.wait, name="child")
        thread.start()
        print([t.name for t in threading.enumerate()], threading.active_count())
        print(threading.main_thread() is threading.current_thread(), threading.main_thread().name)
        release.set()

    assert run(target).stdout == "['MainThread', 'child'] 2\nTrue MainThread\n"
    assert threading.main_thread() is threading.current_thread()


def test_uncaught_exception_is_printed_as_threading_does(run):
    def fail():
        raise ValueError("flat tyre")

    def target():
        thread = threading.Thread(target=fail, name="wheel")
        thread.start()
        thread.join()
        print("main goes on")

    ended = run(target)
    lines = ended.stderr.splitlines()
    assert lines[:2] == ["Exception in thread wheel:", "Traceback (most recent call last):"]
    assert "in _bootstrap_inner" in lines[2]
    assert not any("runtime/process" in line for line in lines)
    assert lines[-1] == "ValueError: flat tyre"
    assert ended.process.exit_code == 0


def test_threading_excepthook_is_per_process(run):
    before = threading.excepthook

    def target():
        threading.excepthook = lambda args: print("hooked", args.exc_type.__name__, args.thread.name)
        thread = threading.Thread(target=lambda: 1 / 0, name="wheel")
        thread.start()
        thread.join()

    assert run(target).stdout == "hooked ZeroDivisionError wheel\n"
    assert threading.excepthook is before


def test_join_times_out(run):
    def target():
        thread = threading.Thread(target=threading.Event().wait, daemon=True)
        thread.start()
        thread.join(0.001)
        print(thread.is_alive())
        thread.join(-1)

    assert run(target).stdout == "True\n"


def test_thread_starts_only_once(run):
    def target():
        thread = threading.Thread(target=lambda: None)
        thread.start()
        thread.join()
        assert "run" not in vars(thread)
        thread.start()

    assert run(target).err[-1] == "RuntimeError: threads can only be started once\n"


def test_subclass_may_override_run(run):
    class Wheel(threading.Thread):
        def run(self):
            print("turns in", current().name)

    def target():
        wheel = Wheel()
        wheel.start()
        wheel.join()

    assert run(target, name="cart").stdout == "turns in cart\n"


def test_exception_thrown_while_a_thread_is_started_is_raised_by_its_starter_afterwards(start, monkeypatch):
    start_thread, processes, outcome = unpatched.start_thread, [], []

    def interrupted_start(thread):
        if thread.name == "wheel":
            processes[0].main_state.throw(KeyboardInterrupt)
            for _unused in range(100_000):  # where the interpreter would raise it, if it could
                pass
        start_thread(thread)

    def target():
        ready.wait()
        wheel = threading.Thread(target=outcome.append, args=("turned",), name="wheel", daemon=True)
        try:
            wheel.start()
        except KeyboardInterrupt:
            wheel.join()
            outcome.append("interrupted")

    ready = threading.Event()
    monkeypatch.setattr(unpatched, "start_thread", interrupted_start)
    started = start(target)
    processes.append(started.process)
    ready.set()
    started.process.wait(LONG)
    assert outcome == ["turned", "interrupted"]
