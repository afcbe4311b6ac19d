"""QoS in rmw_zenoh's text format: six fields, each empty for its default value."""

from __future__ import annotations

from enum import IntEnum
from functools import lru_cache
from typing import NamedTuple, TypeVar

from bot_console.runtime.rmw.qos import Period, Profile
from bot_console.runtime.rmw.qos_matching import INFINITE
from bot_console.runtime.rmw.zenoh.wire.keys import FormatError

DEFAULT_DEPTH = 42
ENDLESS = 2**63 - 1
"""The longest duration (ns), which means no limit."""
NS_PER_S = 1_000_000_000
MAX_INT64 = 2**63 - 1
_M = TypeVar("_M", bound=IntEnum)


class History(IntEnum):
    """Which messages are kept; the values are rmw's, here and below."""

    SYSTEM_DEFAULT = 0
    KEEP_LAST = 1
    KEEP_ALL = 2
    UNKNOWN = 3


class Reliability(IntEnum):
    """Whether lost messages are resent."""

    SYSTEM_DEFAULT = 0
    RELIABLE = 1
    BEST_EFFORT = 2
    UNKNOWN = 3
    BEST_AVAILABLE = 4


class Durability(IntEnum):
    """Whether late subscriptions get earlier messages."""

    SYSTEM_DEFAULT = 0
    TRANSIENT_LOCAL = 1
    VOLATILE = 2
    UNKNOWN = 3
    BEST_AVAILABLE = 4


class Liveliness(IntEnum):
    """How a publisher shows that it is alive."""

    SYSTEM_DEFAULT = 0
    AUTOMATIC = 1
    MANUAL_BY_TOPIC = 3
    UNKNOWN = 4
    BEST_AVAILABLE = 5


class Span(NamedTuple):
    """A duration."""

    nanoseconds: int = ENDLESS


class WireQos(NamedTuple):
    """The QoS profile of an endpoint in another process."""

    reliability: Reliability = Reliability.RELIABLE
    durability: Durability = Durability.VOLATILE
    history: History = History.KEEP_LAST
    depth: int = DEFAULT_DEPTH
    deadline: Span = Span()
    lifespan: Span = Span()
    liveliness: Liveliness = Liveliness.AUTOMATIC
    liveliness_lease_duration: Span = Span()


def encode_qos(qos: Profile) -> str:
    """Encode a profile; policies that are left to the middleware are resolved as by rmw_zenoh."""
    reliability = _member_or_default(Reliability, qos.reliability.name, Reliability.RELIABLE)
    durability = _member_or_default(Durability, qos.durability.name, Durability.VOLATILE)
    history = _member_or_default(History, qos.history.name, History.KEEP_LAST)
    liveliness = _member_or_default(Liveliness, qos.liveliness.name, Liveliness.AUTOMATIC)
    depth = qos.depth or DEFAULT_DEPTH
    fields = (
        _unless(reliability, Reliability.RELIABLE),
        _unless(durability, Durability.VOLATILE),
        f"{_unless(history, History.KEEP_LAST)},{_unless(depth, DEFAULT_DEPTH)}",
        _duration(qos.deadline),
        _duration(qos.lifespan),
        f"{_unless(liveliness, Liveliness.AUTOMATIC)},{_duration(qos.liveliness_lease_duration)}",
    )
    return ":".join(fields)


@lru_cache(256)  # a graph of thousands of endpoints has only a few different profiles
def decode_qos(text: str) -> WireQos:
    """Decode a profile; raises `FormatError`."""
    fields = text.split(":")
    if len(fields) != 6:
        raise FormatError(f"a quality of service has 6 fields, not {len(fields)}: {text!r}")
    reliability, durability, history, deadline, lifespan, liveliness = fields
    history_parts = _parts(history, 2, text)
    alive = _parts(liveliness, 3, text)
    return WireQos(
        _member(Reliability, reliability, Reliability.RELIABLE, text),
        _member(Durability, durability, Durability.VOLATILE, text),
        _member(History, history_parts[0], History.KEEP_LAST, text),
        _number(history_parts[1], DEFAULT_DEPTH, text) or DEFAULT_DEPTH,
        _span(_parts(deadline, 2, text), text),
        _span(_parts(lifespan, 2, text), text),
        _member(Liveliness, alive[0], Liveliness.AUTOMATIC, text),
        _span(alive[1:], text),
    )


def _unless(value: int, default: int) -> str:
    return "" if value == default else str(int(value))


def _member_or_default(kind: type[IntEnum], name: str, default: IntEnum) -> IntEnum:
    """Return the member with that name; the default if the profile leaves the choice open."""
    found = kind.__members__.get(name, default)
    return default if found.name in ("SYSTEM_DEFAULT", "UNKNOWN", "BEST_AVAILABLE") else found


def _duration(period: Period) -> str:
    nanoseconds = period.nanoseconds
    if nanoseconds in INFINITE:
        return ","
    seconds, rest = divmod(nanoseconds, NS_PER_S)
    endless_seconds, endless_rest = divmod(ENDLESS, NS_PER_S)
    return f"{_unless(seconds, endless_seconds)},{_unless(rest, endless_rest)}"


def _parts(field: str, count: int, text: str) -> list[str]:
    parts = field.split(",")
    if len(parts) != count:
        raise FormatError(f"{count} parts are needed in {field!r} of the quality of service {text!r}")
    return parts


def _number(part: str, default: int, text: str) -> int:
    if not part:
        return default
    if not (part.isascii() and part.isdecimal() and len(part) <= 20 and int(part) <= MAX_INT64):
        raise FormatError(f"no number: {part!r} in the quality of service {text!r}")
    return int(part)


def _member(kind: type[_M], part: str, default: _M, text: str) -> _M:
    try:
        return kind(_number(part, default, text))
    except ValueError as error:
        raise FormatError(f"no {kind.__name__.lower()}: {part!r} in the quality of service {text!r}") from error


def _span(parts: list[str], text: str) -> Span:
    seconds, rest = (
        _number(part, default, text) for part, default in zip(parts, divmod(ENDLESS, NS_PER_S), strict=True)
    )
    return Span(min(ENDLESS, seconds * NS_PER_S + rest))
