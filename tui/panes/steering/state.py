"""What steering by keys means: two velocities, an arming switch, and a time-out that stops the robot. Pure."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from bot_console.tui.console.model import Kind, ParameterTree

STEPS = 20
"""Key presses from standing still to the greatest velocity."""

DEADMAN_TIMES = (1.0, 2.0, 5.0, 10.0)
"""Seconds without a key after which the robot is stopped. Terminals tell no key release, so a time-out has to do."""

GREATEST = (1.0, 3.0)
"""Limits (m/s, rad/s) where no parameter gives any."""

DEAD_MAN, LEFT = "dead-man: no key came", "the steering was left"
OWN_REASONS = (DEAD_MAN, LEFT)
"""Why this pane stops the robot; it stands until a person takes the steering again or hands it back."""

SPEED_PARAMETER, TURN_PARAMETER = "max_speed", "turn_rate"


@dataclass
class Steering:
    """The command that the keys have made so far (m/s, rad/s)."""

    linear: float = 0.0
    angular: float = 0.0
    armed: bool = False
    deadman: float = DEADMAN_TIMES[1]
    greatest: tuple[float, float] = GREATEST
    last_key: float = 0.0
    said_zero: bool = True
    expired: bool = False
    """Whether the dead-man time has run out, and nobody has taken the steering since."""

    def arm(self, now: float) -> None:
        """Take keys from now on; the robot stands until one moves it."""
        self.armed, self.last_key, self.expired = True, now, False
        self.linear = self.angular = 0.0

    def disarm(self) -> None:
        """Take no more keys; the robot stands still."""
        self.armed = False
        self.zero()

    def zero(self) -> None:
        """Stand still; the zero is sent even when it was sent before."""
        self.linear = self.angular = 0.0
        self.said_zero = False

    def zero_axis(self, axis: int, now: float) -> None:
        """Zero linear (0) or angular (1) velocity."""
        self.last_key, self.expired, self.said_zero = now, False, False
        if axis == 0:
            self.linear = 0.0
        else:
            self.angular = 0.0

    def steer(self, linear: int, angular: int, steps: int, now: float) -> None:
        """Change the command by steps of a twentieth of what is allowed; it never passes through zero unnoticed."""
        self.last_key, self.expired = now, False
        self.linear = _moved(self.linear, linear * steps, self.greatest[0])
        self.angular = _moved(self.angular, angular * steps, self.greatest[1])

    def limit(self, greatest: tuple[float, float]) -> None:
        """Other limits hold: the command stays inside them."""
        self.greatest = greatest
        self.linear = max(-greatest[0], min(self.linear, greatest[0]))
        self.angular = max(-greatest[1], min(self.angular, greatest[1]))

    def left(self, now: float) -> float:
        """The share of the dead-man time that is left, 0 to 1."""
        return max(0.0, min(1.0, 1.0 - (now - self.last_key) / self.deadman)) if self.armed else 0.0

    def command(self, now: float) -> tuple[float, float] | None:
        """What to send now: velocities again and again, a zero once. The dead-man time ends the steering."""
        moving = (self.linear, self.angular) != (0.0, 0.0)
        if self.armed and moving and now - self.last_key >= self.deadman:
            self.disarm()
            self.expired, moving = True, False
        if not moving and self.said_zero:
            return None
        self.said_zero = not moving
        return self.linear, self.angular


def _moved(value: float, steps: int, greatest: float) -> float:
    if steps == 0:
        return value
    moved = round(value + steps * greatest / STEPS, 9)
    if value * moved < 0:
        return 0.0
    return max(-greatest, min(moved, greatest))


def greatest_of(trees: Iterable[ParameterTree]) -> tuple[float, float]:
    """The limits of speed and turn that the nodes' own parameters give."""
    found = {SPEED_PARAMETER: GREATEST[0], TURN_PARAMETER: GREATEST[1]}
    for tree in trees:
        for parameter in tree.parameters:
            value = parameter.value
            if parameter.name in found and parameter.kind is Kind.DOUBLE and isinstance(value, float) and value > 0:
                found[parameter.name] = value
    return found[SPEED_PARAMETER], found[TURN_PARAMETER]
