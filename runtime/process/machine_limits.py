"""Limits that the system sets for this process (`ulimit`).

Soft limits are raised as far as necessary and allowed, and under a limit of the address space little is reserved.
Native libraries abort the process or panic, without a message of ours, if they cannot reserve memory or open a file, so
what they need must be available before they are used.
"""

from __future__ import annotations

import os
import sys

ARENAS_VARIABLE, M_ARENA_MAX = "MALLOC_ARENA_MAX", -8
"""Names of glibc's limit on its arenas, for programs to be started and for this one; each arena reserves 64 MiB."""
BLAS_VARIABLE = "OPENBLAS_NUM_THREADS"
"""OpenBLAS reserves 32 MiB for each of its threads; by default there is one per processor."""


def hard_limit_below(name: str, wanted: int) -> int | None:
    """Raise a soft limit (`RLIMIT_...`) to `wanted` unless it is at least that; return the hard limit if it is too low.

    Windows has no such limits.
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
    """Make this program and those that it starts reserve little address space, if the address space is limited.

    Separate arenas and buffers only make threads faster. Call this before any thread is started.
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
    except (AttributeError, ValueError, OSError):  # not glibc, or a value that glibc cannot read either
        return


def require_address_space(kib: int) -> None:
    """Raise `MemoryError` unless `kib` KiB of address space are left, or a soft limit could be raised that far."""
    if hard_limit_below("RLIMIT_AS", (_address_space_kib() + kib) * 1024) is not None:
        raise MemoryError


def require_descriptors(count: int) -> None:
    """Raise `OSError` (`EMFILE`) unless `count` more files can be open at once."""
    held: list[int] = []
    try:
        held.append(os.open(os.devnull, os.O_RDONLY))
        while len(held) < count:
            held.append(os.dup(held[0]))
    finally:
        for each in held:
            os.close(each)


def _address_space_kib() -> int:
    """Return the address space (KiB) that this process has reserved; 0 if the system does not tell."""
    try:
        with open("/proc/self/statm", "rb") as file:
            return int(file.read().split()[0]) * os.sysconf("SC_PAGESIZE") // 1024
    except (OSError, ValueError, IndexError):
        return 0
