"""A differential drive with limits: what its wheels do with a velocity command."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class DriveLimits:
    """Speeds in m/s and rad/s, accelerations in m/s² and rad/s², lengths in m, `command_timeout` in s."""

    max_speed: float = 5.0
    max_turn_rate: float = 4.0
    acceleration: float = 2.5
    deceleration: float = 5.0
    turn_acceleration: float = 10.0
    wheel_separation: float = 0.3
    radius: float = 0.2
    command_timeout: float = 0.3


class DifferentialDrive:
    """Speeds of the wheels, as linear (m/s) and angular (rad/s) velocity, one time step after the other."""

    def __init__(self, limits: DriveLimits) -> None:
        self.limits = limits
        self.linear = 0.0
        self.angular = 0.0
        self._asked = (0.0, 0.0)
        self._age = 0.0

    def command(self, linear: float, angular: float) -> None:
        """Take a new command; it holds until the next one or until it is older than `command_timeout`."""
        self._asked = (linear, angular)
        self._age = 0.0

    @property
    def timed_out(self) -> bool:
        """Whether the last command is too old to be obeyed."""
        return self._age > self.limits.command_timeout

    def advance(self, dt: float) -> None:
        """Let `dt` s pass: the wheels change speed towards the command as fast as they may."""
        limits = self.limits
        linear, angular = (0.0, 0.0) if self.timed_out else self._feasible()
        self._age += dt
        brakes = self.linear * linear < 0.0 or abs(linear) < abs(self.linear)
        change = (limits.deceleration if brakes else limits.acceleration) * dt
        self.linear += _clamp(linear - self.linear, change)
        self.angular += _clamp(angular - self.angular, limits.turn_acceleration * dt)

    def _feasible(self) -> tuple[float, float]:
        """The command within the speed limits, slowed on its own curve where the outer wheel could not keep up."""
        limits = self.limits
        linear, angular = _clamp(self._asked[0], limits.max_speed), _clamp(self._asked[1], limits.max_turn_rate)
        outer = abs(linear) + 0.5 * limits.wheel_separation * abs(angular)
        share = min(1.0, limits.max_speed / outer) if outer > 0.0 else 1.0
        return linear * share, angular * share


def _clamp(value: float, limit: float) -> float:
    return max(-limit, min(limit, value))
