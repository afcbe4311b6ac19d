"""Forks of a node (`multiprocessing`, `os.fork`): the child is a real process, set up like the node's process."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from typing import TYPE_CHECKING

from ..node.thread_state import local

if TYPE_CHECKING:
    from ..roles import CurrentProcess

_DESCRIPTORS = {"stdout": 1, "stderr": 2}


class Forks:
    """Prepares forks of node threads; in the child, `make_real` removes all wrappers."""

    def __init__(self, make_real: Callable[[], None]) -> None:
        self._make_real = make_real
        self._registered = False

    def register(self) -> None:
        """Take part in every fork from now on."""
        if not self._registered and hasattr(os, "register_at_fork"):
            self._registered = True
            os.register_at_fork(before=self._before, after_in_child=self._in_child)

    def _before(self) -> None:
        for name in _DESCRIPTORS:
            capture = getattr(local.process, name)
            if capture is not None:
                capture.fileno()  # the child can reach the pipe into the sink, but not the sink itself

    def _in_child(self) -> None:
        process = local.process
        if process.main_state is None:
            return
        del local.process
        local.state = local.task = local.waits_on = None
        self._make_real()
        _become(process)


def _become(process: CurrentProcess) -> None:
    for name, descriptor in _DESCRIPTORS.items():
        capture = getattr(process, name)
        if capture is not None:
            os.dup2(capture.fileno(), descriptor)
            setattr(sys, name, open(descriptor, "w", buffering=1, closefd=False))  # noqa: SIM115 -- for the life of the process
    sys.stdin = open(os.devnull)  # noqa: SIM115 -- the same
    sys.argv = process.argv
    sys.path = process.path
    environment = dict(process.env)
    os.environ.clear()
    os.environ.update(environment)
