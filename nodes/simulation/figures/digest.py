"""The digest of a run, which is equal for two runs in which the robot's poses are identical bit by bit."""

from __future__ import annotations

import hashlib
import struct

VERSION = 1
"""Has to change with anything that gives equal runs other digests: the hashed data, the physics, the order of turns."""
_BATCH = 3 * 256
"""The number of values that are hashed together; the digest does not depend on it."""


class PoseDigest:
    """A hash over every pose."""

    def __init__(self) -> None:
        self._hash = hashlib.blake2b(digest_size=16)
        self._kept: list[float] = []

    def add(self, x: float, y: float, heading: float) -> None:
        """Add a pose: m, m, rad."""
        kept = self._kept
        kept += (x, y, heading)
        if len(kept) >= _BATCH:
            self._take_in()

    def _take_in(self) -> None:
        self._hash.update(struct.pack(f"<{len(self._kept)}d", *self._kept))
        self._kept.clear()

    @property
    def hex(self) -> str:
        """The digest as 32 hexadecimal digits."""
        self._take_in()
        return self._hash.hexdigest()
