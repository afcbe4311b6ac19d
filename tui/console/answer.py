"""The outcome of a command. Uses only the standard library, since the protocols build on it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Answer:
    """The outcome of a command: whether it succeeded, and a message that says what was done or why it was not."""

    ok: bool
    text: str = ""
