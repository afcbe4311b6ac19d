"""The runtime's files in the user's folders; the console's files are beside them."""

from __future__ import annotations

import os
import sys
from functools import cache
from pathlib import Path

OVERRIDE = "BOT_CONSOLE_USER_DIR"
"""Environment variable that names one folder for all files, for instance on a borrowed account."""

XDG = {
    "user_data_path": ("XDG_DATA_HOME", "~/.local/share"),
    "user_cache_path": ("XDG_CACHE_HOME", "~/.cache"),
    "user_state_path": ("XDG_STATE_HOME", "~/.local/state"),
}
"""The folders on Linux. Importing platformdirs for them would take a thirtieth of the time to a launch's first node."""


def data_folder() -> Path:
    """Return the folder for permanent additions by the user (`~/.local/share/bot-console` on Linux)."""
    given = os.environ.get(OVERRIDE)
    return Path(given) / "data" if given else _platform("user_data_path")


def cache_folder() -> Path:
    """Return the folder for files that can be regenerated (`~/.cache/bot-console` on Linux)."""
    given = os.environ.get(OVERRIDE)
    return Path(given) / "cache" if given else _platform("user_cache_path")


def state_folder() -> Path:
    """Return the folder for files that outlive a run, such as stops (`~/.local/state/bot-console` on Linux)."""
    given = os.environ.get(OVERRIDE)
    return Path(given) / "state" if given else _platform("user_state_path")


@cache
def _platform(kind: str) -> Path:
    if sys.platform == "linux":
        variable, default = XDG[kind]
        given = os.environ.get(variable, "")
        return Path(given if os.path.isabs(given) else os.path.expanduser(default)) / "bot-console"
    import platformdirs

    return getattr(platformdirs, kind)("bot-console", appauthor=False)
