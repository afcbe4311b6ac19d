"""The code of the shim modules that a launched program imports as `rclpy` etc.: see `child_environment`."""

from __future__ import annotations

import importlib
import os
import sys

from bot_console.runtime.importer import install
from bot_console.runtime.rmw.zenoh.domain.discovery_range import is_in_range
from bot_console.runtime.rmw.zenoh.domain.domain_bus import share_domains


def give_way(name: str) -> None:
    """Replace a shim, which is just being imported, by the runtime's module.

    The program joins its domain, unless its environment prevents that.
    """
    folder = os.path.dirname(os.fspath(sys.modules[name].__file__ or ""))
    sys.path[:] = [each for each in sys.path if each != folder]
    install()
    if is_in_range():
        share_domains()
    del sys.modules[name]
    importlib.import_module(name)
