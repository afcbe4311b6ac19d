"""Descriptors of the console's own, which other code of this process and its children leave alone."""

from __future__ import annotations

import fcntl

FIRST_DESCRIPTOR = 100
"""The lowest number of our descriptors, beyond those that programs usually close or count."""


def private_duplicate(descriptor: int) -> int:
    """Return a duplicate that no child inherits; raises `OSError`."""
    return fcntl.fcntl(descriptor, fcntl.F_DUPFD_CLOEXEC, FIRST_DESCRIPTOR)
