"""The errors of unreadable YAML: the library's own, and those raised by tags such as `!!timestamp`."""

from __future__ import annotations

import yaml

UNREADABLE = (yaml.YAMLError, ValueError, TypeError, AttributeError, LookupError, OverflowError, RecursionError)


def fault_of(error: Exception) -> str:
    """Describe the error on one line, with the line number if it is known."""
    mark = getattr(error, "problem_mark", None)
    where = f"line {mark.line + 1}: " if mark else ""
    if isinstance(error, yaml.YAMLError):
        # Errors of YAML's character reader have a `reason`, those of its parser a `problem`.
        return where + str(getattr(error, "problem", None) or getattr(error, "reason", None) or "cannot be read")
    return "nested too deeply" if isinstance(error, RecursionError) else "has a value that its tag does not allow"
