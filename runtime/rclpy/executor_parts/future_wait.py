"""Blocking until another thread has settled a future."""

from __future__ import annotations

from typing import Any

from bot_console.runtime.process import current
from rclpy.exceptions import ROSInterruptException
from rclpy.executor_parts.deadlock import WARNING_DELAY_NS, report_deadlock
from rclpy.task import Future


def wait_until_settled(future: Future[Any], entity: Any, node: Any, what: str, deadline_ns: int | None = None) -> None:
    """Block until the future, which a node's entity settles, is done or cancelled, or until a steady time (ns).

    If it never can be, a notice says so after a while, which calls the wait `what`.
    Without a deadline it raises `ROSInterruptException` when the context is shut down, as no answer is received after
    that. Upstream keeps waiting, so that its program never ends.
    """
    clock, context = current().clock, node.context
    wakeup = clock.wakeup()
    future._when_settled(wakeup.set)  # pyright: ignore[reportPrivateUsage] -- rclpy is one library
    if future._settled():  # pyright: ignore[reportPrivateUsage] -- as above
        return
    if deadline_ns is not None:
        warning_ns = min(deadline_ns, clock.steady_ns() + WARNING_DELAY_NS)
        if not wakeup.wait(warning_ns):
            report_deadlock(entity, node, what)
            wakeup.wait(deadline_ns)
        return
    forget = context.on_end(lambda: wakeup.set())  # noqa: PLW0108 -- a method would be held weakly, which takes longer
    try:
        if not wakeup.wait(clock.steady_ns() + WARNING_DELAY_NS):
            report_deadlock(entity, node, what)
            wakeup.wait()
    finally:
        forget()
    if not future._settled():  # pyright: ignore[reportPrivateUsage] -- as above
        current().deliver_signals()  # Ctrl-C shuts down as well: the waiting thread shall see `KeyboardInterrupt`
        raise ROSInterruptException
