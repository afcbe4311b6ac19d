"""Finds the launch files of the machine's packages, in the background because there may be hundreds."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Sequence
from pathlib import Path

ENDINGS = ("launch.py", "launch.xml", "launch.yaml", "launch.yml")
"""The suffixes that `ros2 launch` recognises: `talker.launch.py`, and `talker_launch.py` as in Nav2 and many others."""
SEARCH_TIMEOUT_S = 2.0
"""The longest time (s) that the first caller waits."""


def launch_files() -> Sequence[str]:
    """The launch files of all packages in the environment; empty if no prefix has been sourced."""
    from ament_index_python.packages import get_packages_with_prefixes

    if not os.environ.get("AMENT_PREFIX_PATH"):
        return ()  # the index would raise OSError; an rclpy installed by pip has no prefix
    found: list[str] = []
    for name, prefix in sorted(get_packages_with_prefixes().items()):
        share = Path(prefix) / "share" / name
        found += (str(each) for each in sorted(share.rglob("*launch.*")) if each.name.endswith(ENDINGS))
    return tuple(found)


class LaunchFiles:
    """Keeps the result of the last search; thread-safe."""

    def __init__(self, poll: Callable[[], Sequence[str]] = launch_files) -> None:
        """Start the first search."""
        self._poll = poll
        self._lock = threading.Lock()
        self._found: Sequence[str] = ()
        self._polled = threading.Event()
        self._watching = False
        self._begin()

    def now(self) -> Sequence[str]:
        """The files found so far; also starts another search for the next caller."""
        if self._polled.wait(SEARCH_TIMEOUT_S):
            self._begin()
        return self._found

    def _begin(self) -> None:
        with self._lock:
            if self._watching:
                return
            self._watching = True
        threading.Thread(target=self._run, name="launch files", daemon=True).start()

    def _run(self) -> None:
        try:
            self._found = self._poll()
        finally:
            self._watching = False
            self._polled.set()
