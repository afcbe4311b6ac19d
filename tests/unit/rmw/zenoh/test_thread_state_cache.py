"""Zenoh's callback threads keep their thread-local data, which the interpreter would discard after each callback."""

import ctypes  # noqa: F401  -- a program that has it keeps a thread from its first callback on
import itertools
import sys
import threading
from collections import defaultdict

import pytest
from bot_console.runtime.rmw.zenoh import thread_state_cache
from bot_console.runtime.rmw.zenoh.domain.mesh import open_session
from bot_console.runtime.rmw.zenoh.thread_state_cache import cache_thread_state, here

TIMEOUT_S = 240.0


class Local(threading.local):
    calls = 0


@pytest.fixture
def calls(socket_folder, monkeypatch):
    """The numbers of a hundred callbacks, counted by each thread, by thread."""
    monkeypatch.setattr(thread_state_cache, "_cached", itertools.count(1))  # others may have used it up
    one, two = open_session(0), open_session(0)
    local, counted, all_here = Local(), defaultdict(list), threading.Event()

    def received(payload, attachment):
        local.calls += 1
        counted[threading.get_ident()].append(local.calls)
        if payload == b"last":
            all_here.set()

    two.declare_subscriber("t", received)
    publisher = one.declare_publisher("t", blocking=True)
    while not counted:
        publisher.put(b"first", b"a")
    for _ in range(100):
        publisher.put(b"more", b"a")
    publisher.put(b"last", b"a")
    assert all_here.wait(TIMEOUT_S)
    yield counted
    one.close()
    two.close()


def test_thread_local_counter_persists_between_callbacks(calls):
    assert all(each == list(range(1, len(each) + 1)) for each in calls.values())


def run_in_thread(call):
    done = []
    thread = threading.Thread(target=lambda: done.append(call()))
    thread.start()
    thread.join(TIMEOUT_S)
    return done[0]


def cached_after(count):
    for _ in range(count):
        cache_thread_state()
    return here.kept


def test_program_with_few_callbacks_imports_nothing_extra(monkeypatch):
    monkeypatch.delitem(sys.modules, "ctypes", raising=False)
    monkeypatch.setattr(thread_state_cache, "_calls", iter(range(1, 1000)))
    monkeypatch.setattr(thread_state_cache, "_cached", iter(range(1, 1000)))
    assert not run_in_thread(lambda: cached_after(thread_state_cache.MIN_CALLBACKS - 1))
    assert "ctypes" not in sys.modules
    assert run_in_thread(lambda: cached_after(1))


def test_cached_threads_are_limited(monkeypatch):
    monkeypatch.setattr(
        thread_state_cache, "_cached", iter(range(thread_state_cache.MAX_THREADS, thread_state_cache.MAX_THREADS + 10))
    )
    monkeypatch.setattr(thread_state_cache, "_calls", iter(range(thread_state_cache.MIN_CALLBACKS, 1000)))
    assert [run_in_thread(lambda: cached_after(1)) for _ in range(3)] == [True, False, False]
