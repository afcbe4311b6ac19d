"""Lines of threads are named, and processor time is measured."""

from __future__ import annotations

import sys
import threading
import time

import pytest
from bot_console.runtime.process import stack_frames
from bot_console.runtime.process.node.running import process_of_thread

LONG = 240.0
linux_only = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="only Linux reports this")


@linux_only
def test_processor_time_includes_ended_threads(start):
    burnt, go_on = threading.Event(), threading.Event()

    def burn():
        while time.thread_time() < 0.03:
            pass

    def target():
        thread = threading.Thread(target=burn)
        thread.start()
        thread.join()
        burnt.set()
        go_on.wait()

    started = start(target)
    assert burnt.wait(LONG)
    assert started.process.cpu_seconds() >= 0.03
    go_on.set()
    started.end()
    assert started.process.cpu_seconds() >= 0.03


def test_line_of_a_thread_is_in_the_users_code(start):
    release = threading.Event()

    def target():
        print("ready")
        release.wait()

    started = start(target)
    started.until_printed("ready")
    assert started.process.line() == f"{__file__}:{target.__code__.co_firstlineno + 2}, in target"
    assert process_of_thread(started.process.main_state.ident) is started.process
    release.set()
    started.end()
    started.process.main_state.thread.join(LONG)
    assert started.process.line() is None


def test_trimming_keeps_causes_and_their_order():
    def inner():
        raise KeyError("inner")

    try:
        try:
            inner()
        except KeyError as error:
            raise ValueError("outer") from error
    except ValueError as caught:
        error = stack_frames.trim(caught)
    names = []
    trace = error.__cause__.__traceback__
    while trace is not None:
        names.append(trace.tb_frame.f_code.co_name)
        trace = trace.tb_next
    assert names == ["test_trimming_keeps_causes_and_their_order", "inner"]


def test_library_frames_are_not_user_code():
    assert stack_frames.is_library(threading.__file__)
    assert stack_frames.is_library(pytest.__file__)
    assert stack_frames.is_library(stack_frames.__file__)
    assert not stack_frames.is_library(__file__)
