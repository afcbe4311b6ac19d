"""Lengths and directions of vectors."""

from __future__ import annotations

from typing import Any

import numpy as np


def vector_norm(data: object, axis: int | None = None, out: np.ndarray | None = None) -> Any:
    """Return the length, along an axis if one is given; the result is written into `out` if that is given."""
    norm = np.sqrt(np.sum(np.square(np.asarray(data, dtype=np.float64)), axis=axis))
    if out is None:
        return norm
    out[...] = norm
    return None


def unit_vector(data: object, axis: int | None = None, out: np.ndarray | None = None) -> Any:
    """Return the vector divided by its length, along an axis if one is given; written into `out` if that is given."""
    values = np.array(data, dtype=np.float64)
    length = np.sqrt(np.sum(np.square(values), axis=axis, keepdims=axis is not None))
    values /= length
    if out is None:
        return values
    out[...] = values
    return None


def random_vector(size: int | tuple[int, ...]) -> np.ndarray:
    """Return random numbers in 0..1."""
    return np.random.random(size)
