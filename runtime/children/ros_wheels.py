"""The rclpy of PyPI: variables that its wheels set in the environment of each Python, and other programs must not get.

Their `.pth` file makes every Python of an environment start a second time, with the folders of their libraries in
`LD_LIBRARY_PATH` and a variable that prevents a third start. Another environment with such wheels would find that
variable but not its own libraries, and programs of an installed ROS would load the wheels' libraries.
"""

from __future__ import annotations

import os
import sys
from collections.abc import MutableMapping

GUARD_VARIABLE = "_ROS_WHEELS_BOOTSTRAP_COMPLETE"
PATH_VARIABLE = "LD_LIBRARY_PATH"


def clear_wheel_environment(environ: MutableMapping[str, str] = os.environ) -> None:
    """Remove the variables that the wheels have added, for all programs that this one starts.

    This process keeps its libraries, since the loader read the path when it started; a Python of this environment adds
    them again. Folders that the user has set stay, in the order in which the wheels left them.
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
