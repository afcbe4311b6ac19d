"""Blocking until another thread has settled a future."""

from __future__ import annotations

from typing import Any

from bot_console.runtime.process import current
from rclpy.exceptions import ROSInterruptException
from rclpy.task import Future


def wait_until_settled(future: Future[Any], context: Any, deadline_ns: int | None = None) -> None:
    """Block until the future is done or cancelled, or until a steady time (ns).

    Without a deadline it raises `ROSInterruptException` when the context is shut down, as no answer is received after
    that. Upstream keeps waiting, so that its program never ends.
    """
    wakeup = current().clock.wakeup()
    future._when_settled(wakeup.set)  # pyright: ignore[reportPrivateUsage] -- rclpy is one library
    if future._settled():  # pyright: ignore[reportPrivateUsage] -- as above
        return
    if deadline_ns is not None:
        wakeup.wait(deadline_ns)
        return
    forget = context.on_end(lambda: wakeup.set())  # noqa: PLW0108 -- a method would be held weakly, which takes longer
    try:
        wakeup.wait()
    finally:
        forget()
    if not future._settled():  # pyright: ignore[reportPrivateUsage] -- as above
        current().deliver_signals()  # Ctrl-C shuts down as well: the waiting thread shall see `KeyboardInterrupt`
        raise ROSInterruptException
