"""Where in a launch file an entity was created."""

from __future__ import annotations

import os
import sys

_RUNTIME = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
_OWN = tuple(
    os.path.join(place, name) + os.sep
    for place in {_RUNTIME, os.path.realpath(_RUNTIME)}
    for name in ("launch", "launch_ros", "launch_xml", "launch_yaml")
)


def origin_of_caller() -> str:
    """Return file and line of the calling code outside launch, as `x.launch.py:12`; empty if there is none."""
    frame = sys._getframe(1)  # pyright: ignore[reportPrivateUsage] -- documented in `sys`
    while frame is not None and frame.f_code.co_filename.startswith(_OWN):
        frame = frame.f_back
    return "" if frame is None else f"{frame.f_code.co_filename}:{frame.f_lineno}"
