"""Whether this process may open as many files as a console needs."""

from __future__ import annotations

import sys

MIN_OPEN_FILES = 256
"""A console has about 90 descriptors open, and its own start at 100."""


def too_few_files() -> str:
    """Why a console cannot open enough files, in one line; raises the soft limit if that is allowed."""
    if sys.platform == "win32":
        return ""
    import resource

    now, maximum = resource.getrlimit(resource.RLIMIT_NOFILE)
    if now == resource.RLIM_INFINITY or now >= MIN_OPEN_FILES:
        return ""
    if maximum == resource.RLIM_INFINITY or maximum >= MIN_OPEN_FILES:
        resource.setrlimit(resource.RLIMIT_NOFILE, (MIN_OPEN_FILES, maximum))
        return ""
    return f"bot-console needs {MIN_OPEN_FILES} open files, and at most {maximum} are allowed here: see `ulimit -Hn`"
