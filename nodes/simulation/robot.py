"""A differential drive with limits, whose wheels respond to velocity commands."""

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
    """The speeds of the wheels as linear (m/s) and angular (rad/s) velocity, advanced in time steps."""

    def __init__(self, limits: DriveLimits) -> None:
        self._limits = limits
        self.linear = 0.0
        self.angular = 0.0
        self._asked = self._feasible = (0.0, 0.0)
        self._age = 0.0

    @property
    def limits(self) -> DriveLimits:
        """The limits of the drive."""
        return self._limits

    @limits.setter
    def limits(self, limits: DriveLimits) -> None:
        self._limits = limits
        self._feasible = limit_to_speeds(*self._asked, limits)

    def command(self, linear: float, angular: float) -> None:
        """Set a new command, which is valid until the next one or until it is older than `command_timeout`."""
        self._asked = (linear, angular)
        self._feasible = limit_to_speeds(linear, angular, self._limits)
        self._age = 0.0

    def advance(self, dt: float) -> None:
        """Advance by `dt` s: the wheels accelerate towards the command within their limits."""
        limits, before = self._limits, self.linear
        linear, angular = (0.0, 0.0) if self._age > limits.command_timeout else self._feasible
        self._age += dt
        if linear != before:
            brakes = before * linear < 0.0 or abs(linear) < abs(before)
            change = (limits.deceleration if brakes else limits.acceleration) * dt
            self.linear += _clamp(linear - before, change)
        if angular != self.angular:
            self.angular += _clamp(angular - self.angular, limits.turn_acceleration * dt)


def limit_to_speeds(linear: float, angular: float, limits: DriveLimits) -> tuple[float, float]:
    """Return a command within the speed limits, slowed along its own curve if the outer wheel could not keep up."""
    linear, angular = _clamp(linear, limits.max_speed), _clamp(angular, limits.max_turn_rate)
    outer = abs(linear) + 0.5 * limits.wheel_separation * abs(angular)
    share = min(1.0, limits.max_speed / outer) if outer > 0.0 else 1.0
    return linear * share, angular * share


def _clamp(value: float, limit: float) -> float:
    return max(-limit, min(limit, value))
