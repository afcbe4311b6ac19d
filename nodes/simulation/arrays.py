"""Array types of this package."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

Floats: TypeAlias = "npt.NDArray[np.float64]"
Ints: TypeAlias = "npt.NDArray[np.int64]"


def table(rows: Iterable[Sequence[float]], columns: int) -> Floats:
    """Return rows of equal length as an array with that many columns, even if there are no rows."""
    result: Floats = np.empty((0, columns), np.float64)
    listed = list(rows)
    return np.array(listed, np.float64) if listed else result
