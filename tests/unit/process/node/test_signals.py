"""Signal handlers set by a node belong to its process and run in its main thread."""

from __future__ import annotations

import asyncio
import signal
import sys
import threading
import time

import pytest
from bot_console.runtime.process import current, on_notice

LONG = 240.0


def test_handler_runs_in_the_main_thread_and_the_wait_continues(start):
    go_on = threading.Event()

    def target():
        def handler(signum, frame):
            print("handled", int(signum), threading.current_thread() is threading.main_thread(), frame is not None)

        assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
        assert signal.signal(signal.SIGINT, handler) is signal.default_int_handler
        assert signal.getsignal(signal.SIGINT) is handler
        print("ready")
        go_on.wait()
        print("went on")

    started = start(target)
    started.until_printed("ready")
    started.process.interrupt()
    started.until_printed("handled 2 True True")
    go_on.set()
    assert started.end() == 0
    assert started.out[-1] == "went on\n"


def test_real_handlers_are_untouched(run):
    before = signal.getsignal(signal.SIGUSR1)
    run(lambda: signal.signal(signal.SIGUSR1, lambda *_: None))
    assert signal.getsignal(signal.SIGUSR1) is before


def test_handler_may_exit(start):
    def target():
        signal.signal(signal.SIGTERM, lambda *_: sys.exit(5))
        print("ready")
        time.sleep(1000)

    started = start(target)
    started.until_printed("ready")
    started.process.terminate()
    assert started.end() == 5


def test_handler_may_exit_from_a_busy_loop(start):
    def target():
        signal.signal(signal.SIGTERM, lambda *_: sys.exit(6))
        print("ready")
        while True:
            pass

    started = start(target)
    started.until_printed("ready")
    started.process.terminate()
    assert started.end() == 6


def test_ignored_signal_does_not_end_the_process(start):
    go_on = threading.Event()

    def target():
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        print("ready")
        go_on.wait()

    started = start(target)
    started.until_printed("ready")
    started.process.interrupt()
    go_on.set()
    assert started.end() == 0


@pytest.mark.parametrize(("signum", "code"), [(signal.SIGHUP, -1), (signal.SIGUSR1, -10), (signal.SIGQUIT, -3)])
def test_signal_without_handler_ends_the_process(start, signum, code):
    started = start(lambda: (print("ready"), time.sleep(1000)))
    started.until_printed("ready")
    started.process.send_signal(signum)
    assert started.end() == code


def test_signals_ignored_by_default_are_ignored(start):
    started = start(lambda: (print("ready"), time.sleep(1000)))
    started.until_printed("ready")
    started.process.send_signal(signal.SIGWINCH)
    assert started.process.is_alive


def test_stop_signal_is_reported_but_not_carried_out(start):
    notices = []
    remove = on_notice(lambda process, text: notices.append(text))
    started = start(lambda: (print("ready"), time.sleep(1000)))
    started.until_printed("ready")
    started.process.send_signal(signal.SIGTSTP)
    remove()
    assert started.process.is_alive
    assert len(notices) == 1 and "pause" in notices[0]


def test_new_handler_replaces_earlier_hooks(start):
    seen = []

    def target():
        current().on_interrupt(lambda signum: seen.append(("early", signum)))
        handled = threading.Event()
        signal.signal(signal.SIGINT, lambda *_: (seen.append("handler"), handled.set()))
        current().on_interrupt(lambda signum: seen.append(("late", signum)), [signal.SIGINT])
        print("ready")
        handled.wait()

    started = start(target)
    started.until_printed("ready")
    started.process.terminate()
    started.process.interrupt()
    assert started.end() == 0
    assert seen == [("early", 15), ("late", 2), "handler"]


def test_signal_works_only_in_the_main_thread(run):
    def target():
        def child():
            try:
                signal.signal(signal.SIGINT, signal.SIG_IGN)
            except ValueError as error:
                print(error)

        thread = threading.Thread(target=child)
        thread.start()
        thread.join()

    assert run(target).stdout == "signal only works in main thread of the main interpreter\n"


@pytest.mark.skipif(sys.version_info < (3, 11), reason="asyncio.run handles the signal itself since 3.11")
def test_asyncio_run_is_interrupted(start):
    def target():
        async def main():
            print("ready")
            await asyncio.Event().wait()

        asyncio.run(main())

    started = start(target)
    started.until_printed("ready")
    started.process.interrupt()
    assert started.end() == -2
