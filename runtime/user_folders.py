"""The runtime's files in the user's folders; the console's own are next to them."""

from __future__ import annotations

import os
from functools import cache
from pathlib import Path

OVERRIDE = "BOT_CONSOLE_USER_DIR"
"""Environment variable: one folder for all of it, for instance on a borrowed account."""


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
    import platformdirs

    return getattr(platformdirs, kind)("bot-console", appauthor=False)
