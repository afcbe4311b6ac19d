"""Recognizes waits that cannot end: a callback waits for an event that only its own group or thread could receive."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

import sys
from collections.abc import Iterator
from types import FrameType
from typing import TYPE_CHECKING, Any

from bot_console.runtime.process import current
from bot_console.runtime.process.notices import notify
from bot_console.runtime.process.stack_frames import line_outside
from rclpy.exceptions import ROSInterruptException
from rclpy.ready_callbacks import ReadyCallbacks
from rclpy.task import Future, Task

if TYPE_CHECKING:
    from rclpy.impl.entity import Entity
    from rclpy.node_parts.base import NodeBase

WARNING_DELAY_NS = 5_000_000_000
"""How long a thread waits before a deadlock is reported."""
GROUP = (
    "{line}: {what} waits in vain: it was called in a callback of {group}, which lets nothing else run until that "
    "callback has ended, and what it waits for arrives in the same group. Give {entity} a callback group of its own "
    "(callback_group=MutuallyExclusiveCallbackGroup()) and spin with a MultiThreadedExecutor, or do not block: await "
    "it in an async callback"
)
THREAD = (
    "{line}: {what} waits in vain: it was called in a callback, and the SingleThreadedExecutor that runs this "
    "callback (group: {group}) has no other thread to receive what it waits for. Spin with a MultiThreadedExecutor, "
    "or do not block: await it in an async callback"
)
UNSPUN = (
    "{line}: {what} waits in vain: no executor spins the node {node}, so nothing is received. Spin it in another "
    "thread, or use rclpy.spin_until_future_complete(node, future)"
)


def report_deadlock(entity: Entity, node: NodeBase, what: str) -> None:
    """Give a notice if the calling thread waits for an event of a node's entity that cannot arrive."""
    frame = sys._getframe(1)
    if text := _cause(entity, frame):
        name = node.get_fully_qualified_name()
        default = " (the default one)" if entity.callback_group is node.default_callback_group else ""
        group = f"a {type(entity.callback_group).__name__} of {name}{default}"
        kind: int = entity.KIND
        line = line_outside(frame)
        notify(current(), text.format(line=line, what=what, group=group, entity=_KINDS[kind], node=name))


def report_future(future: Any, executor: Any) -> None:
    """Give a notice if a future, for which the calling thread spins an executor, cannot be completed that way."""
    for node in executor.get_nodes():
        for entity in tuple(node._ros_entities):
            if entity.awaits(future) and _is_blocked(entity, sys._getframe(1)):
                report_deadlock(entity, node, "spinning until a future is complete")


def runs_in_callback() -> bool:
    """Whether the calling thread is inside a callback of an executor."""
    return next(_running_callbacks(sys._getframe(1)), None) is not None


def _cause(entity: Entity, frame: FrameType) -> str:
    if _is_blocked(entity, frame):
        return GROUP
    if any(executor is entity.sink and executor.receives_in_one_thread for executor, _ in _running_callbacks(frame)):
        return THREAD
    return UNSPUN if entity.sink is None else ""


def _is_blocked(entity: Entity, frame: FrameType) -> bool:
    """Whether a callback of the entity's group runs further up the stack and prevents the entity from being served."""
    group = entity.callback_group
    return any(each.callback_group is group for _, each in _running_callbacks(frame)) and not group.can_execute(entity)


def _running_callbacks(frame: FrameType | None) -> Iterator[tuple[Any, Any]]:
    """Yield the executors that run callbacks further up the stack, each with the entity whose callback it runs."""
    while frame is not None:
        if frame.f_code.co_name == "_run":
            executor: Any = frame.f_locals.get("self")
            item: Any = frame.f_locals.get("item")
            if isinstance(executor, ReadyCallbacks):
                entity = executor._tasks.get(item) if item.__class__ is Task else item
                if entity is not None:
                    yield executor, entity
        frame = frame.f_back


_KINDS = ("the action client", "the timer", "the subscription", "the guard condition", "the client", "the service")
"""The names of entities, by kind."""


def wait_until_settled(
    future: Future[Any], entity: Entity, node: NodeBase, what: str, deadline_ns: int | None = None
) -> None:
    """Block until the future, which a node's entity completes, is done or cancelled, or until a steady time (ns).

    If that can never happen, a notice says so after a while; `what` describes the wait. Without a deadline it raises
    `ROSInterruptException` when the context is shut down, as no answer can arrive after that. Upstream would keep
    waiting, and the program never end.
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
        current().deliver_signals()  # Ctrl-C also ends the context: the waiting thread should see `KeyboardInterrupt`
        raise ROSInterruptException
