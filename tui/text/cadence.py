"""When figures that change all the time are drawn again. Pure."""

from __future__ import annotations


def is_due(before: float, now: float, every: float) -> bool:
    """Whether a multiple of `every` seconds lies between two times of the same clock.

    What is drawn once a second is then drawn at the same moments everywhere on the screen: in one frame, not in one
    frame for each widget.
    """
    return not now // every <= before // every  # also true if `before` is infinitely long ago, whose quotient is NaN
