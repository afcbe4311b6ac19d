"""Nodes whose executables are missing: C++ packages that only a machine with ROS 2 has."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import launch.logging
from ament_index_python.packages import PackageNotFoundError
from bot_console.runtime.programs.hints import at, no_package
from bot_console.runtime.programs.missing_packages import what_provides
from bot_console.runtime.workspace.available_names import package_names
from bot_console.runtime.workspace.executables import executables
from bot_console.runtime.workspace.not_found import what_to_add
from launch.substitutions import SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.events.node_missing import NodeMissing

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

ALLOWED = "allow_missing"
"""The local, or launch configuration, that determines whether a launch continues without them."""


def allow_missing(service: Any) -> None:
    """Make a launch service skip nodes whose executables are missing."""
    service.context.extend_globals({ALLOWED: True})


def _is_missing_allowed(context: LaunchContext) -> bool:
    configured = context.launch_configurations.get(ALLOWED, "")
    return configured.lower() in ("true", "1") or bool(context.get_locals_as_dict().get(ALLOWED))


def may_start(context: LaunchContext, action: Any, package: str | None) -> bool:
    """Return whether a node's executable exists; if not, False if it may be skipped, else raise the look-up's error."""
    logger = launch.logging.get_logger("launch")
    try:
        perform_substitutions(context, action.process_description.cmd[0])
    except (PackageNotFoundError, SubstitutionFailure) as error:
        what = str(error).strip().strip('"')
        executable = perform_substitutions(context, normalize_to_list_of_substitutions(action.node_executable))
        has = _what_it_has(package or "", executable)
        brings = has or what_provides(package or "")
        if _is_missing_allowed(context):
            logger.warning(f"left out a node: {what}. {brings}")
            reason = f"{what}. {brings}"
            event = NodeMissing(action=action, package=package or "", executable=executable, reason=reason)
            context.emit_event_sync(event)
            return False
        if has:
            logger.warning(at(action.origin, f"{has} --allow-missing leaves out what is missing"))
        else:
            meant = at(action.origin, no_package(package or "", package_names()))
            if meant:
                logger.warning(meant)
            logger.warning(
                f"a node of package '{package}' cannot run here. {brings} Leave out what is missing with "
                "--allow-missing, or run this launch file on a machine where the package is installed"
            )
        raise
    return True


def _what_it_has(package: str, executable: str) -> str:
    """Describe the executables of an installed package and how it gets this one; empty if neither is known."""
    try:
        names = sorted(executables(package))
    except PackageNotFoundError:
        return ""
    hint = what_to_add(package, executable)
    return f"{package} has: {', '.join(names) or 'none'}{hint}." if names or hint else ""
