"""How values of parameters are written on a command line."""

from __future__ import annotations


def literal_text(value: object) -> str:
    """A value as written in YAML."""
    return str(value).lower() if isinstance(value, bool) else str(value)
