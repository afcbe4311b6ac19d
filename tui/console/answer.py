"""The outcome of a command. Standard library only: below the protocols, which all answer with it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Answer:
    """The outcome of a command: whether it was done, and in words why not, or what was done."""

    ok: bool
    text: str = ""
