"""Decides which parameter changes make the robot less safe; nothing else decides that.

ROS does not mark such parameters, so their names and descriptions are examined: distances at which a robot stops or
slows down, limits of its speed, filters and protections that can be switched. The rules are the same whoever sets a
value.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import Enum
from functools import lru_cache

from bot_console.tui.console.model import ParameterInfo, Value


class UnsafeDirection(Enum):
    """The direction of change that makes the robot less safe."""

    LOWER = "lowers a safety margin"
    HIGHER = "raises a safety limit"
    BLINDER = "makes the robot see less"
    LATER = "lets the robot drive longer without commands"
    OFF = "turns a protection off"
    ON = "turns a protection off by switching it on"


@dataclass(frozen=True)
class Rule:
    """A pattern for the names or descriptions of parameters, and the direction of change that is less safe."""

    worse: UnsafeDirection
    name: re.Pattern[str]
    description: re.Pattern[str] | None = None

    def fits(self, name: str, description: str) -> bool:
        """Whether the rule applies to a parameter."""
        return bool(self.name.search(name) or (self.description and self.description.search(description)))


def _words(text: str) -> re.Pattern[str]:
    return re.compile(text, re.IGNORECASE)


_PROTECTION = "safe|safety|emergency|collision|protective|obstacle|bumper|cliff|watchdog"
_MOTION = "speed|velocity|vel|acceleration|accel|jerk|turn_rate|force|torque"
NUMBERS = (
    Rule(UnsafeDirection.LATER, _words(r"(watchdog|dead_?man|heartbeat|command|cmd|cmd_vel)_?(timeout|time|silence)")),
    Rule(
        UnsafeDirection.LOWER,
        _words(
            rf"(^|_)({_PROTECTION}|stop|stopping|warning|slowdown|min|minimum)_(.*_)?(distance|clearance|margin|radius|gap)"
            r"|clearance|inflation_radius|safety_margin"
        ),
        _words(r"\b(stop\w*|slower|slow down)\b.*\bdistance|minimum .*clearance"),
    ),
    Rule(UnsafeDirection.BLINDER, _words(r"(detection|obstacle)_threshold")),
    Rule(
        UnsafeDirection.HIGHER,
        _words(rf"^(max|maximum)_(.*_)?({_MOTION})(_|$)|({_MOTION})_(limit|max)"),
        _words(r"\b(maximum|highest|largest)\b.*\b(speed|velocity|acceleration|turn rate)\b"),
    ),
)
SWITCHES = (
    Rule(UnsafeDirection.ON, _words(rf"(disable|bypass|ignore|override)d?_.*({_PROTECTION}|filter|stop|limit)")),
    Rule(UnsafeDirection.OFF, _words(rf"(^|_)({_PROTECTION}|filter|filters|filtering)(_|$)|(speed|velocity)_limit")),
)


def takes_safety(parameter: ParameterInfo, before: Value, after: Value) -> str:
    """How a change makes the robot less safe, as the end of a sentence; empty if it does not."""
    name = parameter.name.rpartition(".")[2]
    for rule in SWITCHES if isinstance(after, bool) else NUMBERS:
        if rule.fits(name, parameter.description):
            return rule.worse.value if _is_worse(rule.worse, before, after) else ""
    return ""


def risky_change(parameter: ParameterInfo) -> str:
    """The change of a parameter that would make the robot less safe, and how; empty if there is none."""
    name = parameter.name.rpartition(".")[2]
    for rule in SWITCHES if isinstance(parameter.value, bool) else NUMBERS:
        if rule.fits(name, parameter.description):
            if isinstance(parameter.value, bool):
                return f"{'true' if rule.worse is UnsafeDirection.ON else 'false'} {rule.worse.value}"
            if isinstance(parameter.value, (int, float)):
                return f"a {'smaller' if rule.worse is UnsafeDirection.LOWER else 'greater'} value {rule.worse.value}"
            return ""
    return ""


DISTANCE = 2
"""The importance of distances, which come after limits."""


def importance(parameter: ParameterInfo) -> int | None:
    """How much a parameter affects how the robot drives; 0 is the most, None if no rule applies.

    Limits of speed come first, then other limits, distances, and all other numbers.
    """
    value, name = parameter.value, parameter.name.rpartition(".")[2]
    if isinstance(value, bool) or not isinstance(value, (int, float)) or parameter.read_only:
        return None
    rule = _number_rule(name, parameter.description)
    if rule is None:
        return None
    if rule.worse is UnsafeDirection.HIGHER:
        return 0 if re.search("speed|vel", name) else 1
    return DISTANCE if rule.worse is UnsafeDirection.LOWER else DISTANCE + 1


@lru_cache(maxsize=20_000)
def _number_rule(name: str, description: str) -> Rule | None:
    return next((each for each in NUMBERS if each.fits(name, description)), None)


def _is_worse(worse: UnsafeDirection, before: Value, after: Value) -> bool:
    if isinstance(before, bool) or isinstance(after, bool):
        return before is not after and after is (worse is UnsafeDirection.ON)
    if not isinstance(before, (int, float)) or not isinstance(after, (int, float)):
        return False
    return after < before if worse is UnsafeDirection.LOWER else after > before
