"""SIGINT and SIGTERM shut down the contexts of the process that receives them."""

from __future__ import annotations

import signal
import weakref
from collections.abc import Callable
from typing import Protocol

from bot_console.runtime.process import ProcessLocal, current
from rclpy.impl.named_enum import NamedIntEnum


class SignalHandlerOptions(NamedIntEnum):
    """Which signals rclpy handles."""

    NO = 0
    SIGINT = 1
    SIGTERM = 2
    ALL = 3


SIGNALS = {
    SignalHandlerOptions.NO: (),
    SignalHandlerOptions.SIGINT: (signal.SIGINT,),
    SignalHandlerOptions.SIGTERM: (signal.SIGTERM,),
    SignalHandlerOptions.ALL: (signal.SIGINT, signal.SIGTERM),
}


class EndsBySignal(Protocol):
    """What signal handling needs of a context."""

    def shut_down_by_signal(self) -> None:
        """Shut down without the callbacks of `on_shutdown`."""


class _State:
    """The signal handling of one process, with its contexts."""

    def __init__(self) -> None:
        self.option = SignalHandlerOptions.NO
        self.remove: Callable[[], None] | None = None
        self.contexts: weakref.WeakSet[EndsBySignal] = weakref.WeakSet()


_state: ProcessLocal[_State] = ProcessLocal(_State)


def install_signal_handlers(options: SignalHandlerOptions = SignalHandlerOptions.ALL) -> None:
    """Make the given signals shut down the contexts of this process."""
    state = _state.get()
    uninstall_signal_handlers()
    if SIGNALS[options]:
        state.remove = current().on_interrupt(lambda signum: shutdown_contexts(), SIGNALS[options])
    state.option = options


def uninstall_signal_handlers() -> None:
    """Stop handling signals."""
    state = _state.get()
    if state.remove is not None:
        state.remove()
        state.remove = None
    state.option = SignalHandlerOptions.NO


def get_current_signal_handlers_options() -> SignalHandlerOptions:
    """Return the signals that are handled now."""
    return _state.get().option


def remember_context(context: EndsBySignal) -> None:
    """Register a context of this process, so that a signal shuts it down."""
    _state.get().contexts.add(context)


def shutdown_contexts() -> None:
    """Shut down all contexts of this process, as a signal does."""
    for context in list(_state.get().contexts):
        context.shut_down_by_signal()
