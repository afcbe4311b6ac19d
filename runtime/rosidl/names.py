"""The kinds of interfaces, and the names of generated modules."""

from __future__ import annotations

import re

KINDS = ("msg", "srv", "action")
"""Also the folders of a package that hold definitions, and the endings of their files."""


def module_name(name: str) -> str:
    """Return the module of an interface: `LaserScan` is in `_laser_scan`, `UInt8` in `_u_int8`."""
    name = re.sub(r"(.)([A-Z][a-z]+)", r"\1_\2", name)
    return "_" + re.sub(r"([a-z0-9])([A-Z])", r"\1_\2", name).lower()
