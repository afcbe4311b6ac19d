"""Values that a person types as YAML, behind a verb."""

from __future__ import annotations

from typing import IO, Any


def read_values(source: str | IO[str]) -> Any:
    """The values.

    Raises `YAMLError` as it comes, which ROS 2 shows as well, and `RuntimeError`, which a command tells on one line,
    for what the library lets fall in other ways.
    """
    import yaml

    try:
        return yaml.safe_load(source)
    except yaml.YAMLError:
        raise
    except (ValueError, TypeError, AttributeError, LookupError, OverflowError):
        why = "a tag has a value that it does not allow"
    except RecursionError:
        why = "it is nested too deeply"
    raise RuntimeError(f"The passed value is no YAML: {why}")
