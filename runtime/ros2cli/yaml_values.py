"""YAML values in the arguments of verbs."""

from __future__ import annotations

import contextlib
from collections.abc import Generator
from typing import IO, Any, cast

MOST_BITS = 14_000
"""Of a whole number; Python writes none of more than 4,300 digits, and no field holds one of more than 64 bits."""


def read_values(source: str | IO[str]) -> Any:
    """The values; raises `YAMLError` and what `told_faults` raises."""
    import yaml

    with told_faults():
        found = yaml.safe_load(source)
        _refuse_endless(found, set())
        return found


@contextlib.contextmanager
def told_faults() -> Generator[None]:
    """Around what reads YAML: its own errors come as they are, for ROS 2 shows them as well.

    Raises `RuntimeError`, which a command tells on one line, for what the library lets fall in other ways.
    """
    import yaml

    try:
        yield
        return
    except yaml.YAMLError:
        raise
    except (ValueError, TypeError, AttributeError, LookupError, OverflowError):
        why = "a tag has a value that it does not allow, or a number is endless"
    except RecursionError:
        why = "it is nested too deeply"
    raise RuntimeError(f"The passed value is no YAML: {why}")


def _refuse_endless(value: Any, seen: set[int]) -> None:
    """Refuse whole numbers that cannot be written; an alias is looked at once, as it may hold itself."""
    if isinstance(value, int):
        if value.bit_length() > MOST_BITS:
            raise OverflowError("endless number")
    elif isinstance(value, (list, dict)) and id(cast(object, value)) not in seen:
        seen.add(id(cast(object, value)))
        for each in cast("dict[Any, Any]", value).items() if isinstance(value, dict) else cast("list[Any]", value):
            for part in each if isinstance(each, tuple) else (each,):
                _refuse_endless(part, seen)
