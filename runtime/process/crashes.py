"""Explanations of exceptions that ended a node process, registered by modules that know the usual causes."""

from __future__ import annotations

from collections.abc import Callable

Explain = Callable[[BaseException], "str | None"]
"""Names cause and mend of an exception, or gives None for one that it does not know."""

MEND = "mend"
"""Attribute of an exception that brings its own explanation: cause and mend, as a text."""

_explainers: list[Explain] = []


def explain_with(explain: Explain) -> None:
    """Ask `explain` about each uncaught exception of a node process; a second time for the same one does nothing."""
    if explain not in _explainers:
        _explainers.append(explain)


def explanation(exception: BaseException) -> str | None:
    """The exception's own explanation, else the first that somebody has; None where nobody has one."""
    if own := getattr(exception, MEND, ""):
        return str(own)
    for explain in _explainers:
        text = explain(exception)
        if text:
            return text
    return None
