"""Scripts of `bot-console check`: one step per line, all parsed and validated before the first is carried out. Pure."""

from __future__ import annotations

import re
import shlex
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from bot_console.tui.panes.alarms.condition import parse_condition as read_condition
from bot_console.tui.text.sanitize import cut

DEFAULT_TIMEOUT_S = 5.0
"""Seconds that an expectation waits unless the script says otherwise."""
MAX_TIMEOUT_S = 3600.0
"""Maximum seconds for a single line."""
SPAN = re.compile(r"(\d+(?:\.\d+)?)\s*(ms|s|min)?")
UNITS = {"ms": 0.001, "s": 1.0, "min": 60.0, "": 1.0}
WITHIN = re.compile(r"\s+(?:within|for)\s+(\S+(?:\s+(?:ms|s|min))?)\s*$")
RATE = re.compile(r"(\S+)\s*(<=|>=|<|>|==)\s*(\S+)")
QUOTED = re.compile(r"""(/\S+:\S+)\s*(==|!=)\s*("[^"]*"|'[^']*'|[A-Za-z_][\w.-]*|\[.*\])""")
"""A comparison with a parameter whose value is not a number."""


class ScriptError(ValueError):
    """A mistake in a script, with its line number."""


@dataclass(frozen=True)
class Step:
    """One line: its number, text, verb, arguments, and time limit (s)."""

    line: int
    text: str
    verb: str
    words: tuple[str, ...] = ()
    seconds: float = DEFAULT_TIMEOUT_S


def read(text: str) -> list[Step]:
    """Parse the steps of a script; raises `ScriptError` for the first line that is not a step."""
    found: list[Step] = []
    for number, line in enumerate(text.splitlines(), 1):
        stripped = line.strip()
        if stripped and not stripped.startswith("#"):
            try:
                found.append(_step(number, stripped))
            except ValueError as error:
                raise ScriptError(f"line {number}: {error}") from None
    if not found:
        raise ScriptError("it contains no step")
    return found


def seconds_of(text: str) -> float:
    """A duration such as `2 s`, `500 ms` or `1 min` in s; raises `ValueError`."""
    found = SPAN.fullmatch(text.strip())
    if found is None:
        raise ValueError(f"'{cut(text, 20)}' is not a duration; write for instance 2 s, 500 ms or 1 min")
    value = float(found[1]) * UNITS[found[2] or ""]
    if value > MAX_TIMEOUT_S:
        raise ValueError(f"a line may take at most {MAX_TIMEOUT_S:g} s")
    return value


def _step(number: int, text: str) -> Step:
    verb, _, rest = text.partition(" ")
    reader = VERBS.get(verb)
    if reader is None:
        raise ValueError(f"'{cut(verb, 20)}' is not one of {', '.join(VERBS)}")
    timed = WITHIN.search(rest) if verb not in ("set", "expect-refused", "wait") else None
    seconds = seconds_of(timed[1]) if timed else DEFAULT_TIMEOUT_S
    rest = rest[: timed.start()] if timed else rest
    words, own = reader(rest.strip())
    return Step(number, text, verb, words, seconds if own is None else own)


ParsedStep = tuple[tuple[str, ...], "float | None"]


def _parameter(usage: str) -> Callable[[str], ParsedStep]:
    def reading(rest: str) -> ParsedStep:
        parts = rest.split(maxsplit=2)
        if len(parts) < 3 or not parts[0].startswith("/"):
            raise ValueError(f"write {usage}")
        return tuple(parts), None

    return reading


def _refused(rest: str) -> ParsedStep:
    try:
        words = shlex.split(rest)
    except ValueError as error:
        raise ValueError(f"{error}; quote values that contain blanks") from None
    if len(words) < 3 or not words[0].startswith("/"):
        raise ValueError("write expect-refused /node parameter value [part of the reason]")
    return (*words[:3], " ".join(words[3:])), None


def _rate(rest: str) -> ParsedStep:
    found = RATE.fullmatch(rest)
    try:
        if found is None:
            raise ValueError
        float(found[3])
    except ValueError:
        raise ValueError("write assert-rate /topic >= 10, optionally with for 5 s") from None
    return (found[1], found[2], found[3]), None


def _expect(rest: str) -> ParsedStep:
    quoted = QUOTED.fullmatch(rest)
    if quoted and quoted[3] not in ("true", "false"):
        return (quoted[1], quoted[2], quoted[3]), None
    read_condition(rest)
    return (rest,), None


def _wait(rest: str) -> ParsedStep:
    return (), seconds_of(rest)


def _words(least: int, maximum: int, usage: str) -> Callable[[str], ParsedStep]:
    def reading(rest: str) -> ParsedStep:
        words = rest.split()
        if not least <= len(words) <= maximum:
            raise ValueError(f"write {usage}")
        return tuple(words), None

    return reading


def _log(rest: str) -> ParsedStep:
    if not rest:
        raise ValueError("write expect-log and a filter as in the log, such as sev:>=warn obstacle")
    return (rest,), None


VERBS: Mapping[str, Callable[[str], ParsedStep]] = {
    "set": _parameter("set /node parameter value"),
    "expect-refused": _refused,
    "expect": _expect,
    "assert-rate": _rate,
    "expect-node": _words(1, 1, "expect-node /name"),
    "expect-no-node": _words(1, 1, "expect-no-node /name"),
    "expect-topic": _words(1, 2, "expect-topic /name [package/msg/Type]"),
    "expect-log": _log,
    "call": _words(2, 2, "call /service package/srv/Type"),
    "wait": _wait,
    "stop": _words(0, 0, "stop"),
}
"""The verbs, each with the function that parses the rest of the line."""
