"""Argument types of `argparse` for numbers; each raises `ArgumentTypeError`."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable

MAX_SEED = 2**63 - 1
"""The largest seed: it is an integer parameter of the simulator."""
MAX_PORT = 65535
"""The largest TCP port."""


def positive(text: str) -> float:
    """A finite number above zero."""
    value = _number(text)
    if not 0 < value < math.inf:
        raise argparse.ArgumentTypeError(f"must be positive and finite, not {text}")
    return value


def seconds(text: str) -> float:
    """A finite duration in seconds; it may be zero."""
    value = _number(text)
    if not 0 <= value < math.inf:
        raise argparse.ArgumentTypeError(f"must not be negative or infinite: {text}")
    return value


def integer(least: int, greatest: int) -> Callable[[str], int]:
    """The type of an integer in a range, both ends included."""

    def parsed(text: str) -> int:
        try:
            value = int(text)
        except ValueError:
            raise argparse.ArgumentTypeError(f"'{text}' is not an integer") from None
        if not least <= value <= greatest:
            raise argparse.ArgumentTypeError(f"must be from {least} to {greatest}, not {text}")
        return value

    return parsed


seed = integer(0, MAX_SEED)
"""The seed of a world."""
port = integer(0, MAX_PORT)
"""A TCP port; 0 is any free one."""


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}' is not a number") from None
