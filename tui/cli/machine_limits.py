"""Checks whether a program fits into this machine's limits (`ulimit`); if not, one line says why and what to do."""

from __future__ import annotations

MIN_OPEN_FILES = 256
"""A console has about 90 descriptors open, and its private ones start at 100."""
MIN_ADDRESS_SPACE_KIB = 500_000
"""With a limited address space, a console reserves 335,000 KiB, and its launch host or a robot 320,000."""
MIN_NODE_ADDRESS_SPACE_KIB = 150_000
"""A small node reserves 85,000 KiB; the session of its context requires more to be left (`Session`)."""
MIN_FILE_SIZE_KIB = 64
"""The parameter files that a launch writes are smaller. Logs that do not fit are reported, but end no program."""


def too_few_files() -> str:
    """Raise the soft limit of open files if necessary; returns why a console cannot open enough, or an empty text."""
    if (maximum := _hard_limit_below("RLIMIT_NOFILE", MIN_OPEN_FILES)) is None:
        return ""
    return f"bot-console needs {MIN_OPEN_FILES} open files, and at most {maximum} are allowed here: see `ulimit -Hn`"


def too_little_address_space(kib: int = MIN_ADDRESS_SPACE_KIB) -> str:
    """Raise the soft limit of the address space if necessary; returns why `kib` is not allowed, or an empty text."""
    if (maximum := _hard_limit_below("RLIMIT_AS", kib * 1024)) is None:
        return ""
    return (
        f"bot-console needs an address space of {kib:,} KiB, and at most {maximum // 1024:,} are "
        "allowed here: see `ulimit -Hv`; `bot-console stop` needs less"
    )


def too_small_files() -> str:
    """Raise the soft limit of file sizes if necessary; returns why a robot cannot write its files, or an empty text."""
    if (maximum := _hard_limit_below("RLIMIT_FSIZE", MIN_FILE_SIZE_KIB * 1024)) is None:
        return ""
    return (
        f"bot-console needs files of {MIN_FILE_SIZE_KIB} KiB to start a robot, and at most {maximum // 1024} KiB are "
        "allowed here: see `ulimit -Hf`"
    )


def no_node_here() -> str:
    """Why not even a small node can be started within the limits of this machine; empty if it can."""
    return too_little_address_space(MIN_NODE_ADDRESS_SPACE_KIB)


def no_robot_here() -> str:
    """Why a robot cannot be started within the limits of this machine; empty if it can."""
    return too_little_address_space() or too_small_files()


def _hard_limit_below(name: str, wanted: int) -> int | None:
    from bot_console.runtime.process.machine_limits import hard_limit_below  # late, since `--version` does not need it

    return hard_limit_below(name, wanted)
