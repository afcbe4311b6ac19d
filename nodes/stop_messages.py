"""The emergency stop as messages: `diagnostic_msgs/DiagnosticStatus`, which every ROS 2 has. See `docs/safety.md`."""

from __future__ import annotations

from bot_console_robot.latch import Lock, Request
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue

RELEASED = "released"
LONGEST = 200
"""Characters of a name or reason; the rest is left out."""


def request_message(request: Request) -> DiagnosticStatus:
    """A request."""
    return DiagnosticStatus(
        level=DiagnosticStatus.WARN,
        name=request.holder,
        message=request.reason,
        hardware_id=request.key,
        values=[KeyValue(key="request", value=request.verb)],
    )


def request_of(message: DiagnosticStatus) -> Request:
    """What a request says; the verb is empty when it says nothing."""
    verb = _short(_values(message).get("request", ""))
    return Request(verb, _short(message.name) or "somebody", _short(message.message), _short(message.hardware_id))


def state_message(lock: Lock, node: str, instance: str, steered_by: str) -> DiagnosticStatus:
    """The state of a node's latch; `instance` is another one after each start of the node."""
    values = {"locked": str(lock.held).lower(), "holder": lock.holder, "reason": lock.reason, "turn": str(lock.turn)}
    values |= {"steered_by": steered_by, "instance": instance}
    return DiagnosticStatus(
        level=DiagnosticStatus.ERROR if lock.held else DiagnosticStatus.OK,
        name=f"{node}: emergency stop",
        message=f"locked by {lock.holder}: {lock.reason}" if lock.held else RELEASED,
        hardware_id=node,
        values=[KeyValue(key=key, value=value) for key, value in values.items()],
    )


def lock_of(message: DiagnosticStatus) -> tuple[Lock, str]:
    """The lock that a state tells of, and the instance; what cannot be read is a lock."""
    values = _values(message)
    held = values.get("locked") != "false"
    turn = values.get("turn", "")
    number = int(turn) if turn.isascii() and turn.isdigit() and len(turn) < LONGEST else 0
    lock = Lock(held, _short(values.get("holder", "")), _short(values.get("reason", "")), number)
    return lock, values.get("instance", "")


def _values(message: DiagnosticStatus) -> dict[str, str]:
    return {each.key: each.value for each in message.values}


def _short(text: str) -> str:
    return text[:LONGEST]
