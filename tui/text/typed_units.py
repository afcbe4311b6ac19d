"""Units typed after a number, converted to the unit of the parameter."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping

from bot_console.tui.text.expression.parse import NUMBER

_LENGTH = {"mm": 1e-3, "cm": 1e-2, "dm": 1e-1, "m": 1.0, "km": 1e3, "in": 0.0254, "ft": 0.3048}
_TIME = {"ns": 1e-9, "us": 1e-6, "µs": 1e-6, "ms": 1e-3, "s": 1.0, "min": 60.0, "h": 3600.0}
_ANGLE = {"rad": 1.0, "mrad": 1e-3, "deg": math.pi / 180, "°": math.pi / 180, "turn": 2 * math.pi}
_SPEED = {"mm/s": 1e-3, "cm/s": 1e-2, "m/s": 1.0, "km/h": 1 / 3.6, "mph": 0.44704}
_TURNING = {"rad/s": 1.0, "deg/s": math.pi / 180, "°/s": math.pi / 180, "rpm": 2 * math.pi / 60}
FAMILIES: tuple[Mapping[str, float], ...] = (
    *(_LENGTH, _TIME, _ANGLE, _SPEED, _TURNING),
    {"Hz": 1.0, "kHz": 1e3, "MHz": 1e6, "1/min": 1 / 60},
    {"g": 1e-3, "kg": 1.0, "t": 1e3},
    {"mN": 1e-3, "N": 1.0, "kN": 1e3},
    {"mV": 1e-3, "V": 1.0, "kV": 1e3},
    {"mm/s²": 1e-3, "cm/s²": 1e-2, "m/s²": 1.0, "g0": 9.80665},
)
_IN_NUMBERS = "eExXbBoO_"
"""Letters that continue a number if they follow it without a blank; no unit begins with one of them."""
_UNIT = re.compile(r"\s*([A-Za-zµ°][A-Za-zµ°0-9/²]*|1/min|%)\s*$")


def split_unit(text: str) -> tuple[str, str]:
    """Split a text such as `2*25 cm` into the text without its unit, and the unit; empty if there is none.

    A name that stands alone, or after an operator, is not a unit; nor is a part of a number such as `1e400`, `0x1F` or
    an unfinished `1e`.
    """
    ends = [each.end() for each in NUMBER.finditer(text) if not _belongs_to_unit(text, each.start())]
    end = max(text.rfind(")") + 1, *ends, 0)
    found = _UNIT.fullmatch(text, end) if end else None
    if found is None or (found[1][0] in _IN_NUMBERS and found.start(1) == end):
        return text, ""
    return text[:end], found[1]


def _belongs_to_unit(text: str, at: int) -> bool:
    """Whether a digit belongs to a name or a unit, as in `g0`, `m/s2` or `1/min`."""
    return (at > 0 and (text[at - 1].isalpha() or text[at - 1] in "_²")) or (
        text[at:].rstrip() == "1/min" and text[:at].rstrip() != text[:at]
    )


def factor(typed: str, wanted: str) -> float:
    """The factor that converts a number from the typed to the wanted unit; raises `ValueError` if it cannot."""
    typed, wanted = typed.replace("^2", "²"), wanted.replace("^2", "²").replace("s^2", "s²")
    if typed == wanted:
        return 1.0
    if typed == "%":
        return 0.01
    family = next((each for each in FAMILIES if wanted in each), None)
    if not wanted:
        raise ValueError(f"this parameter names no unit, so {typed} cannot be turned into it")
    if family is None or typed not in family:
        known = ", ".join(family) if family else wanted
        raise ValueError(f"{typed} is not a unit for {wanted}; understood: {known}")
    return family[typed] / family[wanted]
