"""The user's folders: settings and layouts, and what the program leaves behind."""

from __future__ import annotations

import os
from pathlib import Path

OVERRIDE = "BOT_CONSOLE_USER_DIR"
"""Environment variable that names one folder for all files, for instance on a borrowed account."""


def config_folder() -> Path:
    """The folder for what a person writes: settings, layouts, profiles (`~/.config/bot-console` on Linux)."""
    given = os.environ.get(OVERRIDE)
    return Path(given) / "config" if given else _platform("user_config_path")


def state_folder() -> Path:
    """The folder for what the program keeps between runs: history, last screen, crash files
    (`~/.local/state/bot-console`).
    """
    given = os.environ.get(OVERRIDE)
    return Path(given) / "state" if given else _platform("user_state_path")


def expanded_path(text: str) -> Path:
    """The path with `~` expanded; that of an unknown user is left as it is, whereas `Path.expanduser` would raise."""
    return Path(os.path.expanduser(text))


def _platform(kind: str) -> Path:
    import platformdirs

    return getattr(platformdirs, kind)("bot-console", appauthor=False)
