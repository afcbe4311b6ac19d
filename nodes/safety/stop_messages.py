"""Converts requests and states to `diagnostic_msgs/DiagnosticStatus`, which every ROS 2 has, and back.

The fields are described in `docs/safety.md`.
"""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass
from typing import Any, cast

from bot_console_robot.safety.latch import RELEASE, Request
from bot_console_robot.safety.lock import MAX_RELEASES, MAX_STOPS, OTHERS, Lock, Release, Stop
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue

RELEASED = "released"
MAX_TEXT_CHARS = 200
"""Maximum characters of an id, a name or a reason; the rest is cut off."""
MAX_IDS = 2 * MAX_STOPS
"""Maximum number of stops that one release may name."""


@dataclass(frozen=True, slots=True)
class State:
    """The state that a lock publishes: who holds the robot, the challenge for a release, the id of the node's start."""

    lock: Lock
    instance: str
    challenge: str = ""
    steered_by: str = ""
    answers: str = ""
    """The question of the request that this state answers; empty if it answers none."""


def request_message(request: Request) -> DiagnosticStatus:
    """The message of a request."""
    values = {"request": request.verb}
    if request.id:
        values["id"] = request.id
    if not request.kept:
        values["kept"] = "false"
    if request.of:
        values["of"] = json.dumps(request.of)
    if request.ids is not None:
        values |= {"ids": json.dumps(request.ids), "challenges": json.dumps(request.challenges)}
    return DiagnosticStatus(
        level=DiagnosticStatus.WARN,
        name=request.holder,
        message=request.reason,
        hardware_id=request.key,
        values=[KeyValue(key=key, value=value) for key, value in values.items()],
    )


def parse_request(message: DiagnosticStatus) -> Request:
    """The request in a message; its verb is empty if the message has none."""
    values = _values(message)
    verb = _short(values.get("request", ""))
    holder = _short(message.name) or "somebody"
    key = _short(message.hardware_id) or holder
    request = Request(
        verb, holder, _short(message.message), key, _short(values.get("id", "")), kept=values.get("kept") != "false"
    )
    if verb != RELEASE:
        return request
    ids = _texts(values["ids"]) if "ids" in values else None
    of = () if "of" not in values else _texts(values["of"]) or (key,)
    return Request(
        verb, holder, request.reason, key, request.id, ids, _texts(values.get("challenges", "")), of, request.kept
    )


def parse_question(message: DiagnosticStatus) -> str:
    """The text in a request that the answer has to quote; empty if there is none."""
    return _short(_values(message).get("question", ""))


def state_message(state: State, node: str) -> DiagnosticStatus:
    """The message of the state of a node's lock."""
    lock = state.lock
    values = {"locked": str(lock.held).lower(), "holder": lock.holder, "reason": lock.reason, "turn": str(lock.turn)}
    values |= {"stops": stops_text(lock.stops), "released": releases_text(lock.released)}
    values |= {"steered_by": state.steered_by, "instance": state.instance, "challenge": state.challenge}
    if state.answers:
        values["answers"] = state.answers
    return DiagnosticStatus(
        level=DiagnosticStatus.ERROR if lock.held else DiagnosticStatus.OK,
        name=f"{node}: emergency stop",
        message=f"locked by {lock.holder}: {lock.reason}" if lock.held else RELEASED,
        hardware_id=node,
        values=[KeyValue(key=key, value=value) for key, value in values.items()],
    )


def parse_state(message: DiagnosticStatus) -> State:
    """The state in a message; an unreadable one counts as locked."""
    values = _values(message)
    turn, instance = _number(values.get("turn")), _short(values.get("instance", ""))
    stops = parse_stops(values.get("stops"), instance)
    if values.get("locked") == "false":
        stops = ()
    elif not stops:  # the node reports only that it is locked
        holder, reason = _short(values.get("holder", "")), _short(values.get("reason", ""))
        stops = (Stop(_older_id(OTHERS, turn, instance), OTHERS, holder, reason, turn),)
    lock = Lock(stops, turn, parse_releases(values.get("released")))
    challenge, steered_by, answers = (_short(values.get(key, "")) for key in ("challenge", "steered_by", "answers"))
    return State(lock, instance, challenge, steered_by, answers)


def stops_text(stops: tuple[Stop, ...]) -> str:
    """Stops as JSON, each as key, holder, reason, turn, id, and whether it is kept; those of older locks end with the
    turn.
    """
    return json.dumps([[each.key, each.holder, each.reason, each.turn, each.id, each.kept] for each in stops])


def parse_stops(text: str | None, instance: str = "") -> tuple[Stop, ...]:
    """The stops in such a text; those of an older lock get an id made from key, turn and instance."""
    found: list[Stop] = []
    for row in _rows(text)[: MAX_STOPS + 1]:
        if len(row) >= 4:
            key, holder, reason = (_short(str(each)) for each in row[:3])
            turn = _number(str(row[3]))
            id = _short(str(row[4])) if len(row) > 4 else _older_id(key, turn, instance)
            found.append(Stop(id, key, holder, reason, turn, len(row) < 6 or row[5] is not False))
    return tuple(found)


def _older_id(key: str, turn: int, instance: str) -> str:
    """The id for a stop of an older lock: the same each time, and short whatever the message contains."""
    return hashlib.sha256(json.dumps([key, turn, instance]).encode()).hexdigest()[:32]


def releases_text(released: tuple[Release, ...]) -> str:
    """Releases as JSON, each as id, by whom, and the turn."""
    return json.dumps([[each.id, each.by, each.turn] for each in released])


def parse_releases(text: str | None) -> tuple[Release, ...]:
    """The releases in such a text."""
    rows = [each for each in _rows(text)[:MAX_RELEASES] if len(each) >= 3]
    return tuple(Release(_short(str(id)), _short(str(by)), _number(str(turn))) for id, by, turn, *_ in rows)


def _rows(text: str | None) -> list[list[Any]]:
    return [cast("list[Any]", each) for each in _json(text) if isinstance(each, list)]


def _texts(text: str) -> tuple[str, ...]:
    return tuple(_short(each) for each in _json(text)[:MAX_IDS] if isinstance(each, str))


def _json(text: str | None) -> list[Any]:
    try:
        read = json.loads(text or "[]")
    except (ValueError, RecursionError):
        return []
    return cast("list[Any]", read) if isinstance(read, list) else []


def _number(text: str | None) -> int:
    return int(text) if text and text.isascii() and text.isdigit() and len(text) < MAX_TEXT_CHARS else 0


def _values(message: DiagnosticStatus) -> dict[str, str]:
    return {each.key: each.value for each in message.values}


def _short(text: str) -> str:
    """The beginning of a text, made encodable, since otherwise a state that contains it could not be published."""
    return text[:MAX_TEXT_CHARS].encode("utf-8", "replace").decode()
