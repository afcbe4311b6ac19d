"""Nodes whose executables are not here: C++ packages that only a machine with ROS 2 has."""

from __future__ import annotations

from typing import Any

import launch.logging
from ament_index_python.packages import PackageNotFoundError
from launch.substitutions import SubstitutionFailure
from launch.utilities import perform_substitutions

ALLOWED = "allow_missing"
"""The local that says whether a launch goes on without them."""


def allow_missing(service: Any) -> None:
    """Let a launch service leave out nodes whose executables are not here."""
    service.context.extend_globals({ALLOWED: True})


def may_start(context: Any, executable: list[Any], package: str | None) -> bool:
    """Whether a node's executable is here; where it is not, False if it may be left out, else the look-up's error."""
    logger = launch.logging.get_logger("launch")
    try:
        perform_substitutions(context, executable)
    except (PackageNotFoundError, SubstitutionFailure) as error:
        what = str(error).strip().strip('"')
        if context.get_locals_as_dict().get(ALLOWED):
            logger.warning(f"left out a node: {what}")
            return False
        logger.warning(
            f"a node of package '{package}' cannot run here. Leave out what is missing with --allow-missing, or run "
            "this launch file on a machine where the package is installed (ROS 2 packages in C++ need ROS 2)"
        )
        raise
    return True
