"""The code behind the stand-in module that a launched program imports as `rclpy`: see `child_environment`."""

from __future__ import annotations

import importlib
import os
import sys

from bot_console.runtime.importer import install
from bot_console.runtime.rmw.zenoh.domain.discovery_range import is_in_range
from bot_console.runtime.rmw.zenoh.domain.domain_bus import share_domains


def give_way(name: str) -> None:
    """Put the runtime in place of a stand-in module, which is just being imported from a folder of such.

    The program takes part in its domain, unless its environment keeps it apart.
    """
    folder = os.path.dirname(os.fspath(sys.modules[name].__file__ or ""))
    sys.path[:] = [each for each in sys.path if each != folder]
    install()
    if is_in_range():
        share_domains()
    del sys.modules[name]
    importlib.import_module(name)
