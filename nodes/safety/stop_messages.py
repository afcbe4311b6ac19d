"""The emergency stop as messages: `diagnostic_msgs/DiagnosticStatus`, which every ROS 2 has. See `docs/safety.md`."""

from __future__ import annotations

import json
from typing import Any, cast

from bot_console_robot.safety.latch import CROWD, MOST, RELEASE, Lock, Request, Stop
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue

RELEASED = "released"
LONGEST = 200
"""Characters of a name or reason; the rest is left out."""


def request_message(request: Request) -> DiagnosticStatus:
    """A request."""
    values = [KeyValue(key="request", value=request.verb)]
    if request.of:
        values.append(KeyValue(key="of", value=json.dumps(request.of)))
    return DiagnosticStatus(
        level=DiagnosticStatus.WARN,
        name=request.holder,
        message=request.reason,
        hardware_id=request.key,
        values=values,
    )


def request_of(message: DiagnosticStatus) -> Request:
    """The request in a message; its verb is empty if the message contains none."""
    values = _values(message)
    verb = _short(values.get("request", ""))
    holder = _short(message.name) or "somebody"
    key, of = _short(message.hardware_id) or holder, values.get("of")
    keys = () if verb != RELEASE or of is None else _texts(of) or (key,)
    return Request(verb, holder, _short(message.message), key, keys)


def state_message(lock: Lock, node: str, instance: str, steered_by: str) -> DiagnosticStatus:
    """The state of a node's latch; `instance` differs after each start of the node."""
    values = {"locked": str(lock.held).lower(), "holder": lock.holder, "reason": lock.reason, "turn": str(lock.turn)}
    values["stops"] = json.dumps([[each.key, each.holder, each.reason, each.turn] for each in lock.stops])
    values |= {"steered_by": steered_by, "instance": instance}
    return DiagnosticStatus(
        level=DiagnosticStatus.ERROR if lock.held else DiagnosticStatus.OK,
        name=f"{node}: emergency stop",
        message=f"locked by {lock.holder}: {lock.reason}" if lock.held else RELEASED,
        hardware_id=node,
        values=[KeyValue(key=key, value=value) for key, value in values.items()],
    )


def lock_of(message: DiagnosticStatus) -> tuple[Lock, str]:
    """The lock in a state message, and the instance; what cannot be read counts as a lock."""
    values = _values(message)
    turn, stops = _number(values.get("turn")), _stops(values.get("stops"))
    if values.get("locked") == "false":
        stops = ()
    elif not stops:  # of a node that reports only that it is locked
        stops = (Stop(CROWD, _short(values.get("holder", "")), _short(values.get("reason", "")), turn),)
    return Lock(stops, turn), values.get("instance", "")


def _stops(text: str | None) -> tuple[Stop, ...]:
    lists = [cast("list[Any]", entry) for entry in _json(text) if isinstance(entry, list)]
    entries = [[str(each) for each in entry] for entry in lists]
    found = [entry for entry in entries if len(entry) == 4][:MOST]
    return tuple(Stop(_short(key), _short(who), _short(why), _number(turn)) for key, who, why, turn in found)


def _texts(text: str) -> tuple[str, ...]:
    return tuple(_short(each) for each in _json(text) if isinstance(each, str))


def _json(text: str | None) -> list[Any]:
    try:
        read = json.loads(text or "[]")
    except (ValueError, RecursionError):
        return []
    return cast("list[Any]", read) if isinstance(read, list) else []


def _number(text: str | None) -> int:
    return int(text) if text and text.isascii() and text.isdigit() and len(text) < LONGEST else 0


def _values(message: DiagnosticStatus) -> dict[str, str]:
    return {each.key: each.value for each in message.values}


def _short(text: str) -> str:
    """The beginning of a text, encodable: else no state that contains it could be published."""
    return text[:LONGEST].encode("utf-8", "replace").decode()
