"""The functions in expressions over curves: of single values, and of the values within a time span."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from functools import reduce
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
OverTime: TypeAlias = "Callable[[Array, Array, float], Array]"

MAX_ARGUMENTS = 9
"""Maximum number of arguments of a variadic function."""


def _power(left: Array, right: Array) -> Array:
    return np.power(left, right)


def _wrap(angle: Array) -> Array:
    """Wrap an angle to -pi..pi."""
    return np.remainder(angle + np.pi, 2 * np.pi) - np.pi


OPERATORS: Mapping[str, Callable[[Array, Array], Array]] = {
    "+": np.add,
    "-": np.subtract,
    "*": np.multiply,
    "/": np.divide,
    "//": np.floor_divide,
    "%": np.remainder,
    "**": _power,
}

PLAIN: Mapping[str, tuple[int, int, Callable[..., Array]]] = {
    **{name: (1, 1, getattr(np, name)) for name in ("abs", "sqrt", "exp", "log", "sin", "cos", "tan")},
    **{name: (1, 1, getattr(np, f"arc{name[1:]}")) for name in ("asin", "acos", "atan")},
    "atan2": (2, 2, np.arctan2),
    "hypot": (2, MAX_ARGUMENTS, lambda *given: reduce(np.hypot, given)),
    "deg": (1, 1, np.degrees),
    "rad": (1, 1, np.radians),
    "round": (1, 1, np.round),
    "wrap": (1, 1, _wrap),
    "min": (2, MAX_ARGUMENTS, lambda *given: reduce(np.minimum, given)),
    "max": (2, MAX_ARGUMENTS, lambda *given: reduce(np.maximum, given)),
}
"""The minimum and maximum number of arguments of each function, and the function."""


def derivative(times: Array, values: Array) -> Array:
    """The change per second since the previous sample; NaN at the first one, and where no time has passed."""
    slope = np.full(len(times), np.nan)
    passed = np.diff(times)
    slope[1:] = np.where(passed > 0, np.diff(values) / np.where(passed > 0, passed, 1.0), np.nan)
    return slope


def integral(times: Array, values: Array) -> Array:
    """The area below the curve since its first sample, by the trapezoidal rule; non-finite values add nothing."""
    pieces = np.diff(times) * (values[1:] + values[:-1]) / 2
    return np.concatenate([np.zeros(min(1, len(times))), np.cumsum(np.where(np.isfinite(pieces), pieces, 0.0))])


NEIGHBOURS_PER_SIDE = 4
"""Samples on either side with which a sample is compared."""
MAX_DEVIATION = 4.0
"""Maximum distance of a sample from the median of its neighbours, in multiples of their median deviation."""


def despike(times: Array, values: Array) -> Array:
    """The curve without outliers: a sample far from its neighbours is replaced by their median (a Hampel filter)."""
    if len(values) < 3:
        return values
    padded = np.pad(values, NEIGHBOURS_PER_SIDE, constant_values=np.nan)
    near = np.lib.stride_tricks.sliding_window_view(padded, 2 * NEIGHBOURS_PER_SIDE + 1)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)  # raised where all neighbours are NaN
        middle = np.nanmedian(near, axis=1)
        deviation = np.nanmedian(np.abs(near - middle[:, None]), axis=1)
    far = np.abs(values - middle) > MAX_DEVIATION * np.maximum(deviation, 1e-9 * np.abs(middle))
    return np.where(far & np.isfinite(middle), middle, values)


OF_CURVES: Mapping[str, Callable[[Array, Array], Array]] = {
    "derivative": derivative,
    "integral": integral,
    "despike": despike,
}
"""Functions of a whole curve."""


def _begins(times: Array, seconds: float) -> npt.NDArray[np.intp]:
    """For each sample, the index of the first one in the span of `seconds` that ends at it."""
    return np.minimum(np.searchsorted(times, times - seconds, side="right"), np.arange(len(times)))


def _sums(values: Array, begins: npt.NDArray[np.intp]) -> Array:
    total = np.concatenate([[0.0], np.cumsum(values)])
    return total[1:] - total[begins]


def mean(times: Array, values: Array, seconds: float) -> Array:
    """The mean of the finite values within the last `seconds` of each sample."""
    return _moments(times, values, seconds)[0]


def std(times: Array, values: Array, seconds: float) -> Array:
    """The standard deviation of the finite values within the last `seconds` of each sample."""
    return _moments(times, values, seconds)[1]


def _moments(times: Array, values: Array, seconds: float) -> tuple[Array, Array]:
    fine = np.isfinite(values)
    middle = float(np.mean(values[fine])) if fine.any() else 0.0  # sums of small numbers lose fewer digits
    begins = _begins(times, seconds)
    count = _sums(fine.astype(float), begins)
    count = np.where(count > 0, count, np.nan)
    off = np.where(fine, values - middle, 0.0)
    first = _sums(off, begins) / count
    second = _sums(off * off, begins) / count
    return first + middle, np.sqrt(np.maximum(second - first * first, 0.0))


def rms(times: Array, values: Array, seconds: float) -> Array:
    """The root mean square of the finite values within the last `seconds` of each sample."""
    middle, spread = _moments(times, values, seconds)
    return np.hypot(middle, spread)


def minimum(times: Array, values: Array, seconds: float) -> Array:
    """The minimum within the last `seconds` of each sample, ignoring NaN."""
    return _extreme(np.fmin, times, values, seconds)


def maximum(times: Array, values: Array, seconds: float) -> Array:
    """The maximum within the last `seconds` of each sample, ignoring NaN."""
    return _extreme(np.fmax, times, values, seconds)


def _extreme(function: np.ufunc, times: Array, values: Array, seconds: float) -> Array:
    if not len(values):
        return values
    ends = np.arange(1, len(values) + 1)
    pairs = np.column_stack([_begins(times, seconds), ends]).ravel()
    found: Array = function.reduceat(np.append(values, np.nan), pairs)[::2]
    return found


OVER_TIME: Mapping[str, OverTime] = {"mean": mean, "min": minimum, "max": maximum, "std": std, "rms": rms}
