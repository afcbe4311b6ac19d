"""The rclpy of PyPI: what its wheels put into the environment of each Python, and programs elsewhere must not get.

Their `.pth` file runs every Python of an environment a second time, with the folders of their libraries in
`LD_LIBRARY_PATH` and a variable against a third run. Another environment with such wheels would find the variable and
not its libraries, and programs of an installed ROS would load those of the wheels.
"""

from __future__ import annotations

import os
import sys
from collections.abc import MutableMapping

GUARD_VARIABLE = "_ROS_WHEELS_BOOTSTRAP_COMPLETE"
PATH_VARIABLE = "LD_LIBRARY_PATH"


def clear_wheel_environment(environ: MutableMapping[str, str] = os.environ) -> None:
    """Remove what the wheels have added, for all programs that this one starts.

    This process keeps its libraries, since the loader has read the path at its start; a Python of this environment adds
    them again. The folders that the user has set stay, in the order that the wheels have left.
    """
    if environ.pop(GUARD_VARIABLE, None) is None:
        return
    kept = [each for each in environ.get(PATH_VARIABLE, "").split(os.pathsep) if each and not _is_added(each)]
    if kept:
        environ[PATH_VARIABLE] = os.pathsep.join(kept)
    else:
        environ.pop(PATH_VARIABLE, None)


def _is_added(folder: str) -> bool:
    name = os.path.basename(folder)
    of_wheel = name.startswith("ros_") and name.endswith(".libs")
    return of_wheel or os.path.realpath(folder) == os.path.realpath(os.path.join(sys.prefix, "lib"))
