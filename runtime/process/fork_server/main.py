"""The program that the fork server's interpreter runs."""

from __future__ import annotations

import gc
import socket

from .ending import run_to_end
from .job import Job, function_named
from .server import NewChild, Server
from .start import become, let_signals_in


def main(descriptor: int, warm_up: str, prepare: str) -> None:
    """Serve the parent at the other end of a socket; in each child, run the child's program."""
    gc.disable()  # nearly all objects created here stay
    function_named(warm_up)()
    gc.collect()
    child = Server(socket.socket(fileno=descriptor), function_named(prepare) if prepare else _nothing).serve()
    if child is None:
        return
    run_to_end(lambda: _run_child(child))


def _nothing(_job: Job) -> None:
    return


def _run_child(child: NewChild) -> None:
    gc.enable()
    program = become(child)
    let_signals_in()
    program()
