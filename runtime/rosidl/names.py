"""The kinds of interfaces, and the names of generated modules."""

from __future__ import annotations

import re

KINDS = ("msg", "srv", "action")
"""Also the names of a package's folders with definitions, and the extensions of their files."""


def module_name(name: str) -> str:
    """Return the module of an interface: `_laser_scan` for `LaserScan`, `_u_int8` for `UInt8`."""
    name = re.sub(r"(.)([A-Z][a-z]+)", r"\1_\2", name)
    return "_" + re.sub(r"([a-z0-9])([A-Z])", r"\1_\2", name).lower()
