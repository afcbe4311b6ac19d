"""Stops for key presses that have not been handled yet."""

from __future__ import annotations

from bot_console.tui.console.robot.stop_link import StopLink

REASON = "ALL STOP"


class EarlyStops:
    """Stops the robot separately for each key press. Thread-safe."""

    def __init__(self, link: StopLink) -> None:
        self._link = link
        self._ids: dict[str, str] = {}

    def __bool__(self) -> bool:
        """Whether the robot is stopped for any key press."""
        return bool(self._ids)

    def hold(self, press: str) -> None:
        """Stop the robot for a key press."""
        self._ids[press] = self._link.add_stop(REASON)

    def settle(self, press: str, *, keep: bool) -> bool:
        """Turn the stop for a key press into an ordinary one, or withdraw it and no other.

        Returns whether that was the console's last stop.
        """
        id = self._ids.pop(press, "")
        if not id or keep:
            self._link.join(id)
            return False
        self._link.withdraw(id)
        return not self._link.has_stop
