"""Node processes for tests: started with captured output, never left running."""

from __future__ import annotations

import threading
import weakref
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from bot_console.runtime.process import ClockSource, NodeProcess, SteppedTime, stepped
from bot_console.runtime.process.virtual.install import uninstall_virtual_process

LONG = 240.0
"""How long (s) a test waits for an expected event before it fails."""


class StartedProcess:
    """A running node process and its output."""

    def __init__(self, process: NodeProcess, target: Callable[[], object], **options: Any) -> None:
        self.process = process
        self.out: list[str] = []
        self.err: list[str] = []
        self._printed = threading.Condition()
        process.start(target, stdout=self._sink(self.out), stderr=self._sink(self.err), **options)

    def _sink(self, lines: list[str]) -> Callable[[str], None]:
        def take(line: str) -> None:
            with self._printed:
                lines.append(line)
                self._printed.notify_all()

        return take

    @property
    def stdout(self) -> str:
        return "".join(self.out)

    @property
    def stderr(self) -> str:
        return "".join(self.err)

    def until_printed(self, text: str) -> None:
        with self._printed:
            assert self._printed.wait_for(lambda: text in self.stdout, LONG), self.stdout + self.stderr

    def end(self) -> int:
        code = self.process.wait(LONG)
        assert code is not None, f"still in {self.process.line()}"
        return code


@pytest.fixture
def start() -> Iterator[Callable[..., StartedProcess]]:
    """Start callables as node processes; afterwards kill those that a test has left running and restore patched
    modules."""
    processes: weakref.WeakSet[NodeProcess] = weakref.WeakSet()

    def start_one(
        target: Callable[[], object], *, name: str = "node", clock: ClockSource | None = None, **options: Any
    ) -> StartedProcess:
        process = NodeProcess(name, clock)
        processes.add(process)
        return StartedProcess(process, target, **options)

    yield start_one
    for process in tuple(processes):
        process.kill()
    uninstall_virtual_process()


@pytest.fixture
def run(start: Callable[..., StartedProcess]) -> Callable[..., StartedProcess]:
    """Run a callable as a node process until it ends."""

    def run_one(target: Callable[[], object], **options: Any) -> StartedProcess:
        started = start(target, **options)
        started.end()
        return started

    return run_one


@pytest.fixture
def clock() -> Iterator[SteppedTime]:
    """A stepped run that the test drives."""
    with stepped() as clock:
        yield clock
    uninstall_virtual_process()
