"""The console when only its connection to the robot's stop exists: before everything else, and after a failure."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from bot_console.tui.console.connection.no_console import NoConsole
from bot_console.tui.console.model import ConsoleSnapshot
from bot_console.tui.console.protocol import ConsoleReading
from bot_console.tui.console.robot.drive_node import DriveNode
from bot_console.tui.console.robot.robot_model import WorldInfo

_UNKNOWN = WorldInfo()


class StopConsole(NoConsole):
    """Refuses every request with the reason, except those that stop the robot or release it."""

    def __init__(self, why: str, known: ConsoleReading, robot: DriveNode) -> None:
        super().__init__(why, known)
        self._known = known
        self._robot = robot
        self.snapshot = self._with_stop

    def _with_stop(self) -> ConsoleSnapshot:
        return replace(self._known.snapshot(), drive=self._robot.link.info(_UNKNOWN))

    def all_stop(self, hold: bool = True, reason: str = "ALL STOP") -> None:
        """Lock the robot's emergency stop, or with `hold=False` withdraw this console's stop."""
        self._robot.link.stop(hold, reason)

    def hold_early(self, press: str) -> None:
        """Stop the robot for a key press that is not processed yet."""
        self._robot.link.hold_early(press)

    def settle_early(self, press: str, *, keep: bool) -> None:
        """Keep that stop, or withdraw it if it was sent for this key press alone."""
        self._robot.link.settle_early(press, keep=keep)

    def release(self, others: Sequence[str]) -> None:
        """Withdraw this console's stop and those of others."""
        self._robot.link.stop(False, "", others)

    def close(self) -> None:
        """Leave the ROS system."""
        self._robot.link.close()
        self._robot.close()
        self._robot.context.try_shutdown()
