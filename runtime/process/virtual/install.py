"""Install all wrappers that let a thread look like a process, and remove them again."""

from __future__ import annotations

import atexit
import os
import queue
import signal
import subprocess
import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from . import (
    child_threads,
    environment,
    fresh_import,
    os_calls,
    pools,
    subprocesses,
    sys_module,
    waits,
)
from .forks import Forks
from .module_property import replace_class

_SHARED = ("umask", "setuid", "setgid", "nice")
_SHARED_SIGNALS = ("alarm", "setitimer")


def _wraps() -> list[tuple[Any, str, Any]]:
    """Return owner, name and replacement of each wrapped public call."""
    wraps: list[tuple[Any, str, Any]] = [
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
        (os, "getpid", os_calls.getpid),
        (os, "getppid", os_calls.getppid),
        (os, "kill", os_calls.kill),
        (os, "_exit", os_calls.exit_now),
        (os, "abort", os_calls.abort),
        (os, "chdir", os_calls.chdir),
        (os, "system", os_calls.system),
        (os, "execv", os_calls.execv),
        (os, "execve", os_calls.execve),
        (signal, "set_wakeup_fd", os_calls.set_wakeup_fd),
        (signal, "signal", os_calls.set_signal_handler),
        (signal, "getsignal", os_calls.signal_handler),
        (signal, "raise_signal", os_calls.raise_signal),
        (atexit, "register", os_calls.register_exit),
        (atexit, "unregister", os_calls.unregister_exit),
        (subprocess.Popen, "__init__", subprocesses.start),
        (ThreadPoolExecutor, "__init__", pools.make),
        (fresh_import.importlib, "import_module", fresh_import.import_module),
    ]
    if hasattr(signal, "pause"):
        wraps.append((signal, "pause", os_calls.pause))
    for owner, names in ((os, _SHARED), (signal, _SHARED_SIGNALS)):
        wraps += [
            (owner, name, os_calls.unavailable(f"{owner.__name__}.{name}", getattr(owner, name)))
            for name in names
            if hasattr(owner, name)
        ]
    return wraps


_undo: list[Callable[[], None]] = []
_guard = threading.Lock()


def install_virtual_process() -> None:
    """Wrap what node processes need; does nothing if already installed. The first `NodeProcess.start` calls it.

    For code outside node processes the only effect is one more lookup per call.
    """
    with _guard:
        if _undo:
            return
        for owner, name, replacement in _wraps():
            _undo.append(_replace(owner, name, replacement))
        _undo.append(replace_class(threading, child_threads.VirtualThreading))
        _undo.append(sys_module.install())
        _forks.register()


def uninstall_virtual_process() -> None:
    """Restore everything; only when no node process runs."""
    with _guard:
        while _undo:
            _undo.pop()()


_forks = Forks(uninstall_virtual_process)


def _replace(owner: Any, name: str, replacement: Any) -> Callable[[], None]:
    original = getattr(owner, name)
    setattr(owner, name, replacement)
    return lambda: setattr(owner, name, original)


def reinstall_stdio() -> None:
    """Restore the routing standard streams after code has replaced them bypassing `sys`' properties."""
    if _undo:
        sys_module.reinstall()
