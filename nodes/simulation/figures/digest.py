"""The digest of a run: equal for two runs in which the robot was at the same places, bit by bit."""

from __future__ import annotations

import hashlib
import struct

_POSE = struct.Struct("<3d")


class PoseDigest:
    """A hash over every pose."""

    def __init__(self) -> None:
        self._hash = hashlib.blake2b(digest_size=16)

    def add(self, x: float, y: float, heading: float) -> None:
        """Take the next pose: m, m, rad."""
        self._hash.update(_POSE.pack(x, y, heading))

    @property
    def hex(self) -> str:
        """32 digits."""
        return self._hash.hexdigest()
