"""Processes that join a domain and obey commands, one per line."""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator

TIMEOUT_S = 240.0
"""Seconds that anything may take on a busy machine."""


class Member:
    """A process with a session; see `mesh_member.py` for the commands it understands."""

    def __init__(self, *arguments: str) -> None:
        program = os.path.join(os.path.dirname(__file__), "mesh_member.py")
        self.process = subprocess.Popen(
            [sys.executable, program, *arguments], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        self.zid = ""

    def wait_until_joined(self) -> Member:
        """Wait for the process to have a session."""
        self.zid = self.read()
        return self

    def report(self, word: str) -> None:
        """Send it a command."""
        assert self.process.stdin
        self.process.stdin.write(word + "\n")
        self.process.stdin.flush()

    def read(self) -> str:
        """The next line of its output."""
        assert self.process.stdout
        line = self.process.stdout.readline()
        assert line, f"the process ended with {self.process.wait()}"
        return line.strip()

    def ask(self, word: str) -> set[str]:
        """Send it a command; return the words of its answer."""
        self.report(word)
        return set(self.read().split())

    def signal(self, number: int) -> None:
        """Send it a signal."""
        self.process.send_signal(number)

    def end(self) -> None:
        """Kill it."""
        self.process.kill()
        self.process.communicate()


@contextlib.contextmanager
def members(count: int, *arguments: str) -> Iterator[list[Member]]:
    """Start this many processes at the same time; yield them when all have joined."""
    started = [Member(*arguments) for _ in range(count)]
    try:
        yield [each.wait_until_joined() for each in started]
    finally:
        for each in started:
            each.end()


def eventually(true: Callable[[], bool]) -> bool:
    """Whether a condition becomes true before the timeout."""
    deadline = time.monotonic() + TIMEOUT_S
    while not true():
        if time.monotonic() > deadline:
            return False
        time.sleep(0.02)
    return True


def all_linked(present: list[Member]) -> bool:
    """Whether each member has a link to all others."""
    ids = {each.zid for each in present}
    return all(each.ask("linked") >= ids - {each.zid} for each in present)


def every_pair_talks(present: list[Member]) -> bool:
    """Whether every member receives a message from every other; repeated, since links are made in the background."""
    ids = {each.zid for each in present}

    def heard() -> bool:
        for each in present:
            each.ask("call")
        return all(each.ask("heard") >= ids - {each.zid} for each in present)

    return eventually(lambda: all_linked(present)) and eventually(heard)
