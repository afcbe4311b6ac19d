"""Installs the embedded runtime in a Python that has imported a shim: see `shims/bot_console_shims.py`."""

from __future__ import annotations

import atexit
import os
import sys
from collections.abc import Callable, Sequence
from importlib.machinery import ModuleSpec, PathFinder
from types import ModuleType, TracebackType

from bot_console.runtime.children.child_discovery import let_children_meet
from bot_console.runtime.importer import install
from bot_console.runtime.process.crashes import explanation
from bot_console.runtime.process.current import MAIN
from bot_console.runtime.process.notices import notify
from bot_console.runtime.process.stack_frames import trim
from bot_console.runtime.rmw.zenoh.domain.discovery_range import is_in_range
from bot_console.runtime.rmw.zenoh.domain.domain_bus import close_shared_buses, share_domains
from bot_console.runtime.stop_file_path import STOP_FILE_VARIABLE, stop_file


def take_over() -> None:
    """Make the ROS names refer to the embedded runtime.

    The program joins its domain, unless its environment prevents that.
    """
    install()
    if sys.excepthook is sys.__excepthook__:
        sys.excepthook = _uncaught
    # First, for folders in the working directory that would be taken for namespace packages.
    sys.meta_path.insert(0, _WorkspaceModules(lambda name: os.path.isfile(os.path.join(name, "package.xml"))))
    sys.meta_path.append(_WorkspaceModules(lambda name: True))
    if is_in_range():
        share_domains()
        # An interpreter that is finalized while Zenoh's threads call into it could crash.
        atexit.register(close_shared_buses)
        let_children_meet(True)
        os.environ[STOP_FILE_VARIABLE] = str(stop_file())


def _uncaught(kind: type[BaseException], exception: BaseException, trace: TracebackType | None) -> None:
    """Print an uncaught exception as `bot-console run` does: with its cause, but without the runtime's own frames."""
    exception.__traceback__ = trace
    trim(exception)
    sys.__excepthook__(kind, exception, exception.__traceback__)
    if isinstance(exception, Exception) and (text := explanation(exception)):
        notify(MAIN, text)


class _WorkspaceModules:
    """A finder for Python packages of the workspace, which is searched only for names that `may_be` in it."""

    def __init__(self, may_be: Callable[[str], bool]) -> None:
        self._may_be = may_be

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Return the spec of a top-level module in the workspace; None for any other name."""
        if path is not None or fullname in sys.stdlib_module_names or not self._may_be(fullname):
            return None
        from bot_console.runtime.workspace.program import source_folders

        return PathFinder.find_spec(fullname, source_folders())
