"""Which of a test's parameters the default run tries."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import pytest


def slow_after(first: int, values: Iterable[Any]) -> list[Any]:
    """The values of a parameter, of which all but the first ones leave the default run: more of the same kind."""
    given = [*values]
    rest = (each if isinstance(each, tuple) else (each,) for each in given[first:])
    return [*given[:first], *(pytest.param(*each, marks=pytest.mark.slow) for each in rest)]
