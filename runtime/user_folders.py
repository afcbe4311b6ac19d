"""The runtime's files in the user's folders; the console's own are next to them."""

from __future__ import annotations

import os
import sys
from functools import cache
from pathlib import Path

OVERRIDE = "BOT_CONSOLE_USER_DIR"
"""Environment variable: one folder for all of it, for instance on a borrowed account."""

XDG = {"user_data_path": ("XDG_DATA_HOME", "~/.local/share"), "user_cache_path": ("XDG_CACHE_HOME", "~/.cache")}
"""Where Linux has them. For these two, platformdirs would be a thirtieth of the time to a launch's first node."""


def data_folder() -> Path:
    """What a person has added for good (`~/.local/share/bot-console` on Linux)."""
    given = os.environ.get(OVERRIDE)
    return Path(given) / "data" if given else _platform("user_data_path")


def cache_folder() -> Path:
    """What can be made again (`~/.cache/bot-console` on Linux)."""
    given = os.environ.get(OVERRIDE)
    return Path(given) / "cache" if given else _platform("user_cache_path")


@cache
def _platform(kind: str) -> Path:
    if sys.platform == "linux":
        variable, default = XDG[kind]
        given = os.environ.get(variable, "")
        return Path(given if os.path.isabs(given) else os.path.expanduser(default)) / "bot-console"
    import platformdirs

    return getattr(platformdirs, kind)("bot-console", appauthor=False)
