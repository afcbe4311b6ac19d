"""Values of parameters as text, as YAML and `ros2 param` write them."""

from __future__ import annotations

import math

from bot_console.tui.console.model import Value
from bot_console.tui.text.yaml_flow import is_plain, quoted


def value_text(value: Value, *, exact: bool = False) -> str:
    """A parameter's value on one line: arrays in YAML's flow syntax, a text as it is.

    With `exact`, doubles have all their digits.
    """
    if value is None:
        return "not set"
    if isinstance(value, tuple):
        return "[" + ", ".join(_element_text(each, exact) for each in value) + "]"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return exact_number(value) if exact else number_text(value)
    return str(value)


def _element_text(value: bool | int | float | str | bytes, exact: bool) -> str:
    if isinstance(value, bytes):
        return f"0x{value.hex()}"
    return yaml_text(value) if isinstance(value, str) else value_text(value, exact=exact)


def yaml_text(text: str) -> str:
    """A text as YAML that reads back as this text, in double quotes if it needs them."""
    return text if is_plain(text) else quoted(text)


def exact_number(value: float) -> str:
    """The shortest text that reads back as exactly this double, in YAML too."""
    if not math.isfinite(value):
        return number_text(value)
    mantissa, e, exponent = repr(value).partition("e")
    return f"{mantissa}{'' if '.' in mantissa else '.0'}{e}{exponent}"


def number_text(value: float) -> str:
    """A double with a decimal point, so that it cannot be mistaken for an integer."""
    if not math.isfinite(value):
        return ".nan" if math.isnan(value) else (".inf" if value > 0 else "-.inf")
    text = f"{value:.10g}"
    return text if any(character in text for character in ".en") else text + ".0"
