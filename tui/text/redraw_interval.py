"""Decides when numbers that change all the time are drawn again. Pure."""

from __future__ import annotations


def is_due(before: float, now: float, every: float) -> bool:
    """Whether a multiple of `every` seconds lies between two times of the same clock.

    Widgets that draw once a second thus do so at the same moments: all in one frame, not each in a frame of its own.
    """
    return not now // every <= before // every  # also true if `before` is infinitely long ago, whose quotient is NaN
