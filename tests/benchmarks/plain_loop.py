"""A plain Python loop as a unit of CPU time, which makes figures of different machines and moments comparable."""

from __future__ import annotations

import time

TURNS = 5_000_000
REFERENCE_S = 0.37
"""Seconds that the loop took on the machine on which the shares in the documentation were first measured."""


def loop_s() -> float:
    """CPU time (s) of the loop."""
    began, turns = time.process_time(), 0
    while turns < TURNS:
        turns += 1
    return time.process_time() - began
