"""The file in which this domain's robots keep their stops, for all nodes that this program runs or starts."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bot_console.runtime.domain_id import domain_id

if TYPE_CHECKING:
    from pathlib import Path

STOP_FILE_VARIABLE = "BOT_CONSOLE_STOP_FILE"
"""Environment variable that names the file to nodes: see `docs/safety.md`."""


def stop_file() -> Path:
    """Return the file that contains the unreleased stops of this domain's robots, and releases.

    An invalid domain, which is reported when a context is created, counts as 0.
    """
    from bot_console.runtime.files.user_folders import state_folder  # loads pathlib, which `--version` does without

    try:
        domain = domain_id()
    except ValueError:
        domain = 0
    return state_folder() / "stops" / f"domain-{domain}.json"
