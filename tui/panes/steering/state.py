"""The state of keyboard steering: two velocities, an arming switch, and a dead-man timeout. Pure."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass

from bot_console.tui.console.model import Kind, ParameterTree
from bot_console.tui.console.robot.command_topics import FINAL, TELEOP
from bot_console.tui.console.robot.fleet import Scope
from bot_console.tui.console.robot.robot_model import STEERING_RATES_HZ, DriveInfo
from bot_console.tui.format import parse_number

STEPS_TO_MAX = 20
"""Key presses from standstill to maximum velocity."""

DEADMAN_TIMES_S = (1.0, 2.0, 5.0, 10.0)
"""Seconds without a key after which the robot is stopped; terminals do not report key releases."""

RATE_HZ = 10.0
"""How often a velocity is repeated by default."""

DEFAULT_LIMITS = (1.0, 3.0)
"""Limits (m/s, rad/s) if no parameter provides them."""

DEAD_MAN, LEFT = "dead-man: no key came", "the steering was left"
SILENT = "held the steering and fell silent"
"""The reason for which the robot stops itself if this console was frozen or cut off; see `docs/safety.md`."""
OWN_REASONS = (DEAD_MAN, LEFT, SILENT)
"""Reasons for which steering leaves the robot stopped, until someone resumes steering or hands the robot back."""

MAX_LIMIT = 10.0
"""Maximum of a typed limit (m/s and rad/s)."""

SPEED_PARAMETER, TURN_PARAMETER = "max_speed", "turn_rate"


@dataclass
class Steering:
    """The command that results from the keys pressed so far (m/s, rad/s)."""

    linear: float = 0.0
    angular: float = 0.0
    sideways: float = 0.0
    """Velocity to the left, in m/s; only holonomic bases obey it."""
    armed: bool = False
    deadman: float = DEADMAN_TIMES_S[1]
    rate: float = RATE_HZ
    """How often (Hz) the command is sent while it is not zero."""
    greatest: tuple[float, float] = DEFAULT_LIMITS
    last_key: float = 0.0
    typed: tuple[float, float] | None = None
    """Limits typed by the user, which replace those from the parameters."""
    sent_zero: bool = True
    expired: bool = False
    """Whether the dead-man time has expired and steering has not been resumed since."""

    def arm(self, now: float) -> None:
        """Accept keys; the robot stands still until one moves it."""
        self.armed, self.last_key, self.expired = True, now, False
        self.linear = self.angular = self.sideways = 0.0

    def disarm(self) -> None:
        """Ignore keys; the robot stands still."""
        self.armed = False
        self.zero()

    def zero(self) -> None:
        """Stop; a zero is sent even if one was sent before."""
        self.linear = self.angular = self.sideways = 0.0
        self.sent_zero = False

    def zero_axis(self, axis: int, now: float) -> None:
        """Zero linear (0) velocity, also sideways, or angular (1) velocity."""
        self.last_key, self.expired, self.sent_zero = now, False, False
        if axis == 0:
            self.linear = self.sideways = 0.0
        else:
            self.angular = 0.0

    def steer(self, linear: int, angular: int, steps: int, now: float) -> None:
        """Change the command by steps of a twentieth of the limit; it always stops at zero before changing sign."""
        self.last_key, self.expired = now, False
        self.linear = _moved(self.linear, linear * steps, self.greatest[0])
        self.angular = _moved(self.angular, angular * steps, self.greatest[1])

    def slide(self, steps: int, now: float) -> None:
        """Change the sideways velocity by steps to the left; the linear limit applies to it."""
        self.last_key, self.expired = now, False
        self.sideways = _moved(self.sideways, steps, self.greatest[0])

    def aim(self, linear: float | None, angular: float | None, now: float) -> None:
        """Set velocities chosen by mouse; None leaves one unchanged."""
        self.last_key, self.expired, self.sent_zero = now, False, False
        if linear is not None:
            self.linear = round(max(-self.greatest[0], min(linear, self.greatest[0])), 3)
        if angular is not None:
            self.angular = round(max(-self.greatest[1], min(angular, self.greatest[1])), 3)

    def limit(self, greatest: tuple[float, float]) -> None:
        """Set other limits, and clip the command to them."""
        self.greatest = greatest
        self.linear = max(-greatest[0], min(self.linear, greatest[0]))
        self.angular = max(-greatest[1], min(self.angular, greatest[1]))
        self.sideways = max(-greatest[0], min(self.sideways, greatest[0]))

    def left(self, now: float) -> float:
        """The remaining share of the dead-man time, 0 to 1."""
        return max(0.0, min(1.0, 1.0 - (now - self.last_key) / self.deadman)) if self.armed else 0.0

    def command(self, now: float) -> tuple[float, float, float] | None:
        """The linear, angular and sideways velocity to send now; None if there is nothing to send. A zero is sent only
        once. Disarms if the dead-man time has expired.
        """
        moving = self.moving
        if self.expires(now):
            self.disarm()
            self.expired, moving = True, False
        if not moving and self.sent_zero:
            return None
        self.sent_zero = not moving
        return self.linear, self.angular, self.sideways

    def expires(self, now: float) -> bool:
        """Whether the dead-man time has expired while the robot is being driven."""
        return self.armed and self.moving and now - self.last_key >= self.deadman

    @property
    def moving(self) -> bool:
        """Whether the command is not zero."""
        return (self.linear, self.angular, self.sideways) != (0.0, 0.0, 0.0)


def _moved(value: float, steps: int, greatest: float) -> float:
    if steps == 0:
        return value
    moved = round(value + steps * greatest / STEPS_TO_MAX, 9)
    if value * moved < 0:
        return 0.0
    return max(-greatest, min(moved, greatest))


def is_stopped_after_steering(drive: DriveInfo) -> bool:
    """Whether only this pane holds the robot, so that one key may resume steering or hand the robot back."""
    if not drive.lockable:  # it is held only by this console's zeros
        return drive.stopped_here and drive.stop_reason in OWN_REASONS
    return bool(drive.stops) and all(each.here and each.reason in OWN_REASONS for each in drive.stops)


def parse_rate(text: str) -> float:
    """Parse a rate in Hz; an empty text is the default; raises `ValueError`."""
    if not text.strip():
        return RATE_HZ
    rate = parse_number(text)
    if not STEERING_RATES_HZ[0] <= rate <= STEERING_RATES_HZ[1]:
        raise ValueError(f"a number from {STEERING_RATES_HZ[0]:g} to {STEERING_RATES_HZ[1]:g}")
    return rate


def robot_of(topic: str, robots: Iterable[str]) -> str:
    """The robot that takes commands on a topic; empty if there is none. Robots may be named by their topics."""
    name = topic if topic.startswith("/") else f"/{topic}"
    namespace, _, token = name.rpartition("/")
    known = set(robots)
    usual = (namespace or "/") if token in (TELEOP, FINAL) else ""
    return next((each for each in (name, usual) if each in known), "")


def parse_limits(text: str) -> tuple[float, float] | None:
    """Parse limits of speed and turn (m/s, rad/s) such as `0.5 1.0`; None for an empty text; raises `ValueError`."""
    words = text.replace(",", " ").split()
    if not words:
        return None
    if len(words) != 2:
        raise ValueError("two numbers, such as 0.5 1.0, or nothing for those of the parameters")
    speed, turn = (parse_number(each) for each in words)
    if not (0 < speed <= MAX_LIMIT and 0 < turn <= MAX_LIMIT):
        raise ValueError(f"each above 0 and at most {MAX_LIMIT:g}")
    return speed, turn


def limits_from_parameters(
    trees: Iterable[ParameterTree], topic: str = "", others: Collection[str] = ()
) -> tuple[float, float]:
    """The limits of speed and turn from the parameters of the steered robot.

    Nodes in the namespace of the topic come first, then those that belong to no other robot; `others` are the
    namespaces of the other robots.
    """
    found = {SPEED_PARAMETER: DEFAULT_LIMITS[0], TURN_PARAMETER: DEFAULT_LIMITS[1]}
    scope = Scope(f"{topic.rpartition('/')[0]}/", frozenset(others))
    every = [each for each in trees if not scope.is_foreign(each.node)]
    own = [each for each in every if scope.owns(each.node)]
    for tree in own or every:
        for parameter in tree.parameters:
            value = parameter.value
            if parameter.name in found and parameter.kind is Kind.DOUBLE and isinstance(value, float) and value > 0:
                found[parameter.name] = value
    return found[SPEED_PARAMETER], found[TURN_PARAMETER]
