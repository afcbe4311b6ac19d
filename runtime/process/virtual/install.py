"""Install all wrappers that let a thread look like a process, and remove them again."""

from __future__ import annotations

import os
import queue
import signal
import threading
import time
from collections.abc import Callable
from typing import Any

from . import child_threads, environment, signal_calls, sys_module, waits
from .module_property import replace_class


def _wraps() -> list[tuple[Any, str, Any]]:
    """Return owner, name and replacement of each wrapped public call."""
    return [
        (threading.Thread, "start", child_threads.start),
        (threading.Thread, "join", child_threads.join),
        (threading.Thread, "is_alive", child_threads.is_alive),
        (threading, "main_thread", child_threads.main_thread),
        (threading, "enumerate", child_threads.enumerate_threads),
        (threading, "active_count", child_threads.active_count),
        (threading.Condition, "wait", waits.condition_wait),
        (queue, "SimpleQueue", waits.SimpleQueue),
        (time, "sleep", waits.sleep),
        (os, "environ", environment.RoutingEnvironment()),
        (signal, "signal", signal_calls.set_signal_handler),
        (signal, "getsignal", signal_calls.signal_handler),
    ]


_undo: list[Callable[[], None]] = []
_guard = threading.Lock()


def install_virtual_process() -> None:
    """Wrap the calls that node processes need; does nothing if already installed. The first `NodeProcess.start` calls
    it.

    For code outside node processes the only effect is one more lookup per call.
    """
    with _guard:
        if _undo:
            return
        for owner, name, replacement in _wraps():
            _undo.append(_replace(owner, name, replacement))
        _undo.append(replace_class(threading, child_threads.VirtualThreading))
        _undo.append(sys_module.install())


def uninstall_virtual_process() -> None:
    """Restore everything; call it only when no node process runs."""
    with _guard:
        while _undo:
            _undo.pop()()


def _replace(owner: Any, name: str, replacement: Any) -> Callable[[], None]:
    original = getattr(owner, name)
    setattr(owner, name, replacement)
    return lambda: setattr(owner, name, original)


def reinstall_stdio() -> None:
    """Restore the routing standard streams after code has replaced them, bypassing the properties of `sys`."""
    if _undo:
        sys_module.reinstall()
