"""Functions that older NumPy releases lack."""

from __future__ import annotations

import numpy as np
from numpy.lib import recfunctions


def structured_to_unstructured(arr: np.ndarray, dtype: np.dtype | None = None, copy: bool = False) -> np.ndarray:
    """Return a structured array as a plain one, whose last dimension is the fields."""
    return recfunctions.structured_to_unstructured(arr, dtype, copy)
