"""Reduces an array or a quaternion to one number: the value of `/scan/ranges.min()` for each message."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt


class NotPlottable(Exception):
    """A path that cannot be plotted; the message says why."""


_MADE: Mapping[str, Callable[[npt.NDArray[np.float64]], float]] = {
    "min": lambda values: float(values.min()),
    "max": lambda values: float(values.max()),
    "mean": lambda values: float(values.mean()),
    "sum": lambda values: float(values.sum()),
    "std": lambda values: float(values.std()),
}


def make(value: Any, made: str, name: str) -> float:
    """Reduce a value with the function `made`, ignoring non-finite elements. Raises `NotPlottable`."""
    if made == "yaw":
        return _yaw(value, name)
    if isinstance(value, (str, bool, int, float, np.number)) or not hasattr(value, "__len__"):
        raise NotPlottable(f"{name} is not an array, so there is no {made} of it")
    if made == "len":
        return float(len(value))
    try:
        values = np.asarray(value, np.float64)
    except (TypeError, ValueError):
        raise NotPlottable(f"{name} is an array whose elements are not numbers") from None
    fine = values[np.isfinite(values)]
    return _MADE[made](fine) if len(fine) else math.nan


def _yaw(value: Any, name: str) -> float:
    """The rotation of a quaternion about the vertical axis, in rad."""
    try:
        w, x, y, z = (float(getattr(value, each)) for each in "wxyz")
    except (AttributeError, TypeError):
        raise NotPlottable(f"{name} is not a quaternion, so there is no yaw of it") from None
    return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
