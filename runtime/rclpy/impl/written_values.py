"""How values of parameters are written on a command line."""

from __future__ import annotations

from typing import Any


def literal_text(value: Any) -> str:
    """A value as written in YAML."""
    return str(value).lower() if isinstance(value, bool) else str(value)


def written(name: str, value: str, expected: str, given: str) -> str:
    """A hint how to write a value for the expected type; type names as in `rclpy.Parameter.Type`."""
    if (expected, given) == ("DOUBLE", "INTEGER"):
        point = f"{value}.0" if value.lstrip("+-").isdecimal() else "it with a point"
        return f"{name} is a double, which takes no integer: write {point}"
    if expected == "STRING":
        return f"{name} is a string: write '\"{value}\"', as {value} alone is read as {given.lower().replace('_', ' ')}"
    if expected == "BOOL":
        return f"{name} is a bool: write true or false"
    return f"{name} takes values of the type {expected.lower().replace('_', ' ')}"
