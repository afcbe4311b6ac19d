"""A number with its noun. Pure."""

from __future__ import annotations


def counted(number: int, word: str) -> str:
    """A number and a noun, in the plural if needed."""
    ending = "es" if word.endswith("s") else "s"
    return f"{number} {word}{'' if number == 1 else ending}"
