"""The outcome of a command. Uses only the standard library, since the protocols build on it."""

from __future__ import annotations

from concurrent.futures import Future
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Answer:
    """The outcome of a command: whether it succeeded, and a message that says what was done or why it was not."""

    ok: bool
    text: str = ""


def answer_of(done: Future[Answer]) -> Answer:
    """The answer of a finished command; an exception becomes an unsuccessful answer."""
    error = done.exception()
    return Answer(False, str(error)) if error else done.result()
