"""The parent process of command lines in tests: it imports what they need once, and forks for each."""

from __future__ import annotations

import gc
import importlib
import json
import os
import runpy
import select
import signal
import socket
import sys
from functools import partial

IMPORTED = (
    "asyncio", "email", "hashlib", "importlib.metadata", "urllib.request",
    "mcap", "numpy.random", "pymunk", "rich.text", "xxhash", "yaml", "zenoh.ext",
    "launch_ros.actions", "rclpy.action", "ros2cli", "rosidl_runtime_py",
    "geometry_msgs.msg", "nav_msgs.msg", "sensor_msgs.msg", "std_msgs.msg", "std_srvs.srv",
    "bot_console.runtime.rmw.zenoh.domain.domain_bus", "bot_console.runtime.rmw.zenoh.network.client",
    "bot_console.runtime.workspace.builtin_package",
    "bot_console.tui.cli.arguments", "bot_console.tui.cli.bags.record", "bot_console.tui.cli.check.runner",
    "bot_console.tui.cli.entry", "bot_console.tui.cli.main", "bot_console.tui.cli.verbs.background",
    "bot_console.tui.cli.verbs.bag", "bot_console.tui.cli.verbs.run", "bot_console.tui.cli.verbs.stop",
)  # fmt: skip


def main() -> None:
    """Fork for each request on the socket; the fork becomes the command line."""
    from bot_console.runtime.importer import install
    from bot_console.runtime.workspace import discover

    install()
    for each in IMPORTED:
        importlib.import_module(each)
    gc.collect()
    gc.freeze()
    words, folder, environment = _requested(socket.socket(fileno=int(sys.argv[1])))
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(environment)
    discover._current.clear()  # a failed import (tomllib on an older Python) has cached this process's folder
    sys.path[0] = folder
    sys.argv[1:] = words
    sys.orig_argv[1:] = ["-m", "bot_console.tui", *words]
    runpy.run_module("bot_console.tui", run_name="__main__", alter_sys=True)


def _requested(asks: socket.socket) -> tuple[list[str], str, dict[str, str]]:
    """Serve until the socket is closed. Returns in a fork only, with the request."""
    reports: dict[int, int] = {}
    woken, wake = os.pipe()
    os.set_blocking(wake, False)
    signal.set_wakeup_fd(wake)
    signal.signal(signal.SIGCHLD, lambda number, frame: None)
    while True:
        ready, _, _ = select.select([asks, woken], [], [])
        if woken in ready:
            os.read(woken, 1024)
            _report_ended(reports)
        if asks in ready:
            message, descriptors, _, _ = socket.recv_fds(asks, 1, 5)
            if not message:
                sys.exit()
            request, *streams, report = descriptors
            if not (pid := os.fork()):
                return _begun(request, streams)
            reports[pid] = report
            os.write(report, b"%d\n" % pid)
            for each in (request, *streams):
                os.close(each)


def _report_ended(reports: dict[int, int]) -> None:
    while reports:
        pid, status = os.waitpid(-1, os.WNOHANG)
        if not pid:
            return
        os.write(reports[pid], b"%d\n" % status)
        os.close(reports.pop(pid))


def _begun(request: int, streams: list[int]) -> tuple[list[str], str, dict[str, str]]:
    """Turn a fork into the state of an interpreter that has just started."""
    signal.set_wakeup_fd(-1)
    signal.signal(signal.SIGCHLD, signal.SIG_DFL)
    with os.fdopen(request) as file:
        requested = json.load(file)
    for place, each in enumerate(streams):
        os.dup2(each, place)
    os.closerange(3, os.sysconf("SC_OPEN_MAX"))
    opened = partial(open, closefd=False)
    sys.stdin = sys.__stdin__ = opened(0)
    sys.stdout = sys.__stdout__ = opened(1, "w")
    sys.stderr = sys.__stderr__ = opened(2, "w", buffering=1, errors="backslashreplace")
    return requested


if __name__ == "__main__":
    main()
