"""The program that the fork server's interpreter runs."""

from __future__ import annotations

import gc
import socket

from .ending import run_to_end
from .job import function_named
from .server import Birth, Server
from .start import become, let_signals_in


def main(descriptor: int, warm_up: str) -> None:
    """Serve the parent at the other end of a socket; in each child, run its program."""
    function_named(warm_up)()
    gc.collect()
    gc.freeze()  # objects that the collector never touches are not copied into each child
    birth = Server(socket.socket(fileno=descriptor)).serve()
    if birth is None:
        return
    run_to_end(lambda: _live(birth))


def _live(birth: Birth) -> None:
    program = become(birth)
    let_signals_in()
    program()
