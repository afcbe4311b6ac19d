"""The outcome of a command. Standard library only: the protocols build on it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Answer:
    """The outcome of a command: whether it succeeded, and in words what was done or why it was not."""

    ok: bool
    text: str = ""
