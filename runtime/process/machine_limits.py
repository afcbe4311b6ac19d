"""Limits that the system sets for this process (`ulimit`): soft ones are raised as far as is needed and allowed, and
under a limit of the address space little is reserved.

Native libraries abort the process, without a word of ours, if they cannot reserve memory. So what they need must be
there before they are used.
"""

from __future__ import annotations

import os
import sys

ARENAS_VARIABLE, M_ARENA_MAX = "MALLOC_ARENA_MAX", -8
"""glibc's limit on its arenas, for programs that are started, and for this one; it reserves 64 MiB for each."""
BLAS_VARIABLE = "OPENBLAS_NUM_THREADS"
"""OpenBLAS reserves 32 MiB for each of its threads, of which there is one for each processor."""


def hard_limit_below(name: str, wanted: int) -> int | None:
    """Raise a soft limit (`RLIMIT_...`) to what is wanted, unless it is as high; return the hard limit if that is too
    low. Windows has no such limits.
    """
    if sys.platform == "win32":
        return None
    import resource

    limit: int = getattr(resource, name)
    now, maximum = resource.getrlimit(limit)
    if now == resource.RLIM_INFINITY or now >= wanted:
        return None
    if maximum == resource.RLIM_INFINITY or maximum >= wanted:
        resource.setrlimit(limit, (wanted, maximum))
        return None
    return maximum


def reserve_little_address_space() -> None:
    """Let this program and those that it starts reserve little address space, if that is limited.

    The arenas and buffers of other threads only make them faster. To be called before any thread is started.
    """
    if sys.platform == "win32":
        return
    import resource

    if resource.getrlimit(resource.RLIMIT_AS)[0] == resource.RLIM_INFINITY:
        return
    os.environ.setdefault(ARENAS_VARIABLE, "1")
    os.environ.setdefault(BLAS_VARIABLE, "1")
    import ctypes

    try:
        ctypes.CDLL(None).mallopt(M_ARENA_MAX, int(os.environ[ARENAS_VARIABLE]))
    except (AttributeError, ValueError, OSError):  # not glibc; or a number that glibc does not read either
        return


def require_address_space(kib: int) -> None:
    """Raise `MemoryError` unless so much address space is left, in KiB, or a soft limit could be raised that far."""
    if hard_limit_below("RLIMIT_AS", (_address_space_kib() + kib) * 1024) is not None:
        raise MemoryError


def _address_space_kib() -> int:
    """The address space that this process has reserved; 0 where the system does not say."""
    try:
        with open("/proc/self/statm", "rb") as file:
            return int(file.read().split()[0]) * os.sysconf("SC_PAGESIZE") // 1024
    except (OSError, ValueError, IndexError):
        return 0
