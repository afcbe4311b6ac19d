"""How values of parameters are written on a command line."""

from __future__ import annotations

from typing import Any


def literal_text(value: Any) -> str:
    """A value as written in YAML."""
    return str(value).lower() if isinstance(value, bool) else str(value)
