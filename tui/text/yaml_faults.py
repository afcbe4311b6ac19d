"""What comes of YAML that cannot be read: its own errors, and those of values that tags such as `!!timestamp` make."""

from __future__ import annotations

import yaml

UNREADABLE = (yaml.YAMLError, ValueError, TypeError, AttributeError, LookupError, OverflowError, RecursionError)


def fault_of(error: Exception) -> str:
    """What is wrong, on one line, with the number of the line where that is known."""
    mark = getattr(error, "problem_mark", None)
    where = f"line {mark.line + 1}: " if mark else ""
    if isinstance(error, yaml.YAMLError):
        # The reader of characters has a reason, the parser a problem.
        return where + str(getattr(error, "problem", None) or getattr(error, "reason", None) or "cannot be read")
    return "nested too deeply" if isinstance(error, RecursionError) else "has a value that its tag does not allow"
