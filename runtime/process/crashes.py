"""Explanations of exceptions that ended a node process, registered by modules that know the usual causes."""

from __future__ import annotations

from collections.abc import Callable

Explain = Callable[[BaseException], "str | None"]
"""Returns the cause of an exception and how to fix it, or None for an unknown one."""

HINT = "bot_console_hint"
"""Attribute of an exception that holds its own explanation: a text with the cause and how to fix it."""

_explainers: list[Explain] = []


def explain_with(explain: Explain) -> None:
    """Register `explain` for the uncaught exceptions of node processes; does nothing if it is already registered."""
    if explain not in _explainers:
        _explainers.append(explain)


def explanation(exception: BaseException) -> str | None:
    """Return the exception's own explanation, or the first from a registered function; None if there is none.

    If a program exits with an error while handling an exception, the explanation is that exception's.
    """
    if isinstance(exception, SystemExit):
        return explanation(exception.__context__) if exception.code and exception.__context__ else None
    if own := getattr(exception, HINT, ""):
        return str(own)
    for explain in _explainers:
        text = explain(exception)
        if text:
            return text
    return None
