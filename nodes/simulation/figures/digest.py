"""The digest of a run: equal for two runs in which the robot's poses are identical bit by bit."""

from __future__ import annotations

import hashlib
import struct

VERSION = 1
"""Changes with anything that gives an unchanged run another digest: what is hashed, the physics, the order of turns."""
_BATCH = 3 * 256
"""How many numbers are collected before they are hashed together; the hash covers their bytes in order."""


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
