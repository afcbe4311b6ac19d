"""Launch arguments not declared by the launch file: accepted, as upstream does, but with a warning."""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING

import launch.logging
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
    """Warns of names that no entity visited before has declared or read."""

    def __init__(self, names: Collection[str]) -> None:
        super().__init__()
        self._names = names

    def execute(self, context: LaunchContext) -> None:
        """Warn of each, suggesting a similar declared name."""
        for name in self._names:
            if name in ALWAYS_KNOWN or name in context.declared_arguments or name in context.read_configurations:
                continue
            import difflib

            near = difflib.get_close_matches(name, sorted(context.declared_arguments), 1)
            hint = f"; did you mean '{near[0]}'?" if near else ""
            launch.logging.get_logger("launch").warning(
                f"the launch argument '{name}' is neither declared nor read by the launch file{hint}"
            )
