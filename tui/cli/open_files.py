"""Whether this process may open as many files as a console needs."""

from __future__ import annotations

import sys

LEAST = 256
"""A console has some 90 descriptors open, and its own ones begin at 100."""


def too_few_files() -> str:
    """Why a console cannot open, in one line; a limit that this process may raise itself is raised."""
    if sys.platform == "win32":
        return ""
    import resource

    now, most = resource.getrlimit(resource.RLIMIT_NOFILE)
    if now == resource.RLIM_INFINITY or now >= LEAST:
        return ""
    if most == resource.RLIM_INFINITY or most >= LEAST:
        resource.setrlimit(resource.RLIMIT_NOFILE, (LEAST, most))
        return ""
    return f"bot-console needs {LEAST} open files, and at most {most} are allowed here: see `ulimit -Hn`"
