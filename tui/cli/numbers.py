"""Numbers among the words of a command line, as types of `argparse`."""

from __future__ import annotations

import argparse

MAX_SEED = 2**63 - 1
"""A seed is an integer parameter of the simulator."""


def positive(text: str) -> float:
    """A number above zero; raises `ArgumentTypeError` or `ValueError`."""
    value = float(text)
    if not 0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"must be positive, not {text}")
    return value


def seed(text: str) -> int:
    """The seed of a world; raises `ArgumentTypeError` or `ValueError`."""
    value = int(text)
    if not 0 <= value <= MAX_SEED:
        raise argparse.ArgumentTypeError(f"must be from 0 to {MAX_SEED}, not {text}")
    return value
