"""Ends a node's thread pools with its main program, as the interpreter does at exit."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from functools import wraps
from typing import TYPE_CHECKING, Any

from ..node.thread_state import local

if TYPE_CHECKING:
    from ..roles import CurrentProcess

_make = ThreadPoolExecutor.__init__


@wraps(_make)
def make(pool: ThreadPoolExecutor, *arguments: Any, **options: Any) -> None:
    """`ThreadPoolExecutor(...)`: the node process records its pools."""
    _make(pool, *arguments, **options)
    if local.process.main_state is not None:
        local.process.end_with_main(pool)


def shut_down(process: CurrentProcess) -> None:
    """Shut down the pools of a process: their threads end once they have finished the submitted work."""
    for pool in list(process.pools):
        pool.shutdown(wait=False)
