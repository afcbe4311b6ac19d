"""Runs a launch file of a real ROS 2 in a launch host, in its main thread, since LaunchService works nowhere else."""

from __future__ import annotations

import queue
import socket
import threading
from collections.abc import Callable

from bot_console.tui.console.launch.launcher import RosLauncher
from bot_console.tui.console.launch.process_output import Add
from bot_console.tui.session.embedded.vitals import SystemVitals
from bot_console.tui.session.launch_host.host import LaunchHost, Printed
from bot_console.tui.session.machine.console_needs import provide_missing, provide_prefixes
from bot_console.tui.session.machine.launch_files import launch_files
from bot_console.tui.settings.settings import read_settings


class MainThreadTask:
    """A piece of work for the main thread."""

    def __init__(self, work: Callable[[], None]) -> None:
        self.work = work
        self.done = threading.Event()

    def join(self, timeout: float | None = None) -> object:
        """Wait until it is done, at most `timeout` seconds."""
        return self.done.wait(timeout)


class MainThread:
    """Runs work for other threads in the main thread, one piece at a time."""

    def __init__(self) -> None:
        self._turns: queue.SimpleQueue[MainThreadTask | None] = queue.SimpleQueue()

    def spawn(self, work: Callable[[], None], file: str) -> MainThreadTask:
        """Queue a launch, which runs once the previous one has ended."""
        turn = MainThreadTask(work)
        self._turns.put(turn)
        return turn

    def serve(self) -> None:
        """Run queued work until `end` is called."""
        while (turn := self._turns.get()) is not None:
            try:
                turn.work()
            finally:
                turn.done.set()

    def end(self) -> None:
        """End `serve` after the queued work."""
        self._turns.put(None)


def host_launches(owner: socket.socket) -> None:
    """Serve until everything has ended at a console's request, or because the owner has gone."""
    provide_missing()
    provide_prefixes()
    main_thread = MainThread()

    def make(record: Add, printed: Printed) -> RosLauncher:
        settings = read_settings()
        return RosLauncher(
            *(record, printed, launch_files, main_thread.spawn, SystemVitals),
            policy=settings.restart_policy,
            restarts=settings.restarts,
        )

    host = LaunchHost(make)

    def end_when_over() -> None:
        host.over.wait()
        main_thread.end()

    threading.Thread(target=end_when_over, name="end", daemon=True).start()
    host.connect(owner, owner=True)
    main_thread.serve()
    host.close()
