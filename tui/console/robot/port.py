"""The port for the robot, with which panes steer and stop it. Standard library only.

What becomes of the commands is in `ConsoleSnapshot.drive`, and the robot's known surroundings are in
`ConsoleSnapshot.world`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from bot_console.tui.console.robot.robot_model import Pose


class Drive(Protocol):
    """Steers and stops the robot; a stop is accepted in every state of the console, and kept until it is confirmed."""

    def move(self, linear: float, angular: float, sideways: float = 0.0) -> None:
        """Send one velocity command (m/s, rad/s; `sideways` in m/s to the left, for holonomic bases); the caller
        repeats it. Silently ignored while an all-stop holds.

        Raises `ValueError` for NaN and infinity.
        """
        ...

    def stop(self, hold: bool = True, reason: str = "ALL STOP") -> None:
        """Lock the robot's emergency stop, or with `hold=False` release this console's stop; in both cases send zero
        velocity now.

        A robot that others have also stopped stays locked until their stops are released. `DriveInfo.stop_confirmed`
        says whether the stop has been acknowledged. A robot without an emergency stop is sent zero velocities as long
        as it is stopped. May be called from any thread.
        """
        ...

    def hold_early(self, press: str) -> None:
        """Stop the robot for a key press that has not been handled yet, with a separate id; send zero velocity now.

        `press` identifies the key press. May be called from any thread.
        """
        ...

    def settle_early(self, press: str, *, keep: bool) -> None:
        """Keep the stop for a key press until it is released like any other, or withdraw it and no other.

        May be called from any thread.
        """
        ...

    def release(self, others: Sequence[str]) -> None:
        """Release this console's stop and the stops of others with these keys (see `DriveInfo.stops`)."""
        ...

    def choose(self, robot: str) -> None:
        """Drive another of `DriveInfo.robots`; an all-stop always applies to all of them."""
        ...

    def steer(self, hold: bool) -> None:
        """Take control of the robot, so that only a person's commands count, or hand it back.

        While the console has control, the claim is repeated at least every 0.5 s; if it falls silent, the robot is
        locked.
        """
        ...

    def pose_at(self, stamp: int) -> Pose | None:
        """The robot's pose at a time (ns since the epoch); None if it is unknown."""
        ...
