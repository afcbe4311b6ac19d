"""Private descriptors of the console, which neither other code of this process nor its children touch."""

from __future__ import annotations

import fcntl

FIRST_DESCRIPTOR = 100
"""The lowest number of a private descriptor, beyond those that programs usually close or count."""


def private_duplicate(descriptor: int) -> int:
    """Return a duplicate that no child inherits; raises `OSError`."""
    return fcntl.fcntl(descriptor, fcntl.F_DUPFD_CLOEXEC, FIRST_DESCRIPTOR)
