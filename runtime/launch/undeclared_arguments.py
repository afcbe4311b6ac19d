"""Launch arguments that the launch file does not declare: accepted as upstream, but with a warning."""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING

import launch.logging
from bot_console.runtime.programs.hints import did_you_mean
from launch.action import Action

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

ALWAYS_KNOWN = frozenset(
    (
        "allow_missing",
        "emulate_tty",
        "isolation",
        "launch-prefix",
        "launch-prefix-filter",
        "ros_namespace",
        "sigkill_timeout",
        "sigterm_timeout",
    )
)


class WarnOfUndeclaredArguments(Action):
    """Warns of argument names that no entity visited before has declared or read."""

    def __init__(self, names: Collection[str]) -> None:
        super().__init__()
        self._names = names

    def execute(self, context: LaunchContext) -> None:
        """Warn of each name, suggesting a similar declared one."""
        for name in self._names:
            if name in ALWAYS_KNOWN or name in context.declared_arguments or name in context.read_configurations:
                continue
            hint = did_you_mean(name, context.declared_arguments, "'")
            launch.logging.get_logger("launch").warning(
                f"the launch argument '{name}' is neither declared nor read by the launch file{hint}"
            )
