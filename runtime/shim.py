"""Puts the embedded runtime in place in a Python that has imported a shim: see `shims/bot_console_shims.py`."""

from __future__ import annotations

import atexit
import os
import sys
from collections.abc import Sequence
from importlib.machinery import ModuleSpec, PathFinder
from types import ModuleType

from bot_console.runtime.children.child_discovery import let_children_meet
from bot_console.runtime.importer import install
from bot_console.runtime.rmw.zenoh.domain.discovery_range import is_in_range
from bot_console.runtime.rmw.zenoh.domain.domain_bus import close_shared_buses, share_domains
from bot_console.runtime.stop_file import STOP_FILE_VARIABLE, stop_file


def take_over(folder: str) -> None:
    """Make the ROS names refer to the embedded runtime; `folder` holds the shims.

    The program joins its domain, unless its environment prevents that.
    """
    install()
    sys.meta_path.append(_WorkspaceModules())
    if is_in_range():
        share_domains()
        # An interpreter that is finalized while Zenoh's threads call into it would crash.
        atexit.register(close_shared_buses)
        let_children_meet(True)
        os.environ[STOP_FILE_VARIABLE] = str(stop_file())


class _WorkspaceModules:
    """A finder that comes last: Python packages of the workspace, which is searched only for names that nobody has."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Return the spec of a top-level module of the workspace; None for every other name."""
        if path is not None or fullname in sys.stdlib_module_names:
            return None
        from bot_console.runtime.workspace.program import source_folders

        return PathFinder.find_spec(fullname, source_folders())
