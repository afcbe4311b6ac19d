"""Which line of a launch file has made something."""

from __future__ import annotations

import os
import sys

_LIBRARIES = tuple(
    os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), name) + os.sep
    for name in ("launch", "launch_ros", "launch_xml", "launch_yaml")
)
_FRONTEND = os.path.join(os.path.dirname(os.path.abspath(__file__)), "frontend") + os.sep


def calling_line() -> tuple[str, int] | None:
    """File and line of the nearest caller outside of launch; None where that is no Python file's."""
    frame = sys._getframe(1)
    while frame is not None:
        name = frame.f_code.co_filename
        if name.startswith(_FRONTEND):
            return None
        if not name.startswith(_LIBRARIES):
            return None if name.startswith("<") else (name, frame.f_lineno)
        frame = frame.f_back
    return None
