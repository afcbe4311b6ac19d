"""`signal.signal` and `signal.getsignal`, answered for the node process instead of the real one."""

from __future__ import annotations

import signal
import threading
from typing import TYPE_CHECKING

from ..node.thread_state import local

if TYPE_CHECKING:
    from ..roles import Handler

_signal = signal.signal
_getsignal = signal.getsignal


def set_signal_handler(signum: int, handler: Handler) -> Handler:
    """`signal.signal`: sets the handler of the calling node process. Raises `ValueError` outside its main thread."""
    if local.process.main_state is None:
        return _signal(signum, handler)  # type: ignore[arg-type] -- checked by the original
    if threading.current_thread() is not threading.main_thread():
        raise ValueError("signal only works in main thread of the main interpreter")
    if not callable(handler) and handler not in (signal.SIG_DFL, signal.SIG_IGN):
        raise TypeError("signal handler must be signal.SIG_IGN, signal.SIG_DFL, or a callable object")
    return local.process.signals.set_handler(int(signum), handler)


def signal_handler(signum: int) -> Handler:
    """`signal.getsignal` of the calling node process."""
    process = local.process
    return _getsignal(signum) if process.main_state is None else process.signals.handler(int(signum))
