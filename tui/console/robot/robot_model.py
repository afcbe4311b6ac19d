"""The robot as the panes see it: its surroundings, and the path of its velocity commands. Standard library only.

Distances are m, angles rad, speeds m/s and rad/s.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

STEERING_RATES_HZ = (1.0, 50.0)
"""The lowest and the highest selectable rate of a person's commands."""


@dataclass(frozen=True, slots=True)
class Pose:
    """A pose in the plane: m, m, rad counter-clockwise from +x."""

    x: float = 0.0
    y: float = 0.0
    heading: float = 0.0


@dataclass(frozen=True, slots=True)
class GridMap:
    """An occupancy grid (`nav_msgs/OccupancyGrid`): row-major from the lower left, 0..100, 255 if unknown."""

    width: int
    height: int
    resolution: float
    origin: Pose
    cells: bytes


@dataclass(frozen=True, slots=True)
class Turtle:
    """A turtle of `turtlesim`: its pose (m, rad), velocity (m/s, rad/s), and a trail if there is no drawing."""

    name: str
    pose: Pose
    speed: float = 0.0
    turn: float = 0.0
    trail: tuple[tuple[float, float], ...] = ()


@dataclass(frozen=True, slots=True)
class Drawing:
    """What turtles have drawn, as RGBA rows from the top; alpha is 255 where something is drawn, else 0.

    Where nothing is drawn, the background colour is shown.
    """

    width: int
    height: int
    pixels: bytes


@dataclass(frozen=True, slots=True)
class TurtleField:
    """The field of a `turtlesim` node, with its turtles."""

    node: str
    turtles: tuple[Turtle, ...] = ()
    drawing: Drawing | None = None


@dataclass(frozen=True, slots=True)
class WorldInfo:
    """The surroundings, as far as they are known: map, robot, trail, and end points of the LIDAR beams (x, y in m)."""

    map: GridMap | None = None
    pose: Pose | None = None
    trail: tuple[tuple[float, float], ...] = ()
    hits: Sequence[tuple[float, float]] = ()
    goal: tuple[float, float] | None = None
    speed: float = 0.0
    turn: float = 0.0
    nearest: float | None = None
    fields: tuple[TurtleField, ...] = ()
    """Fields with turtles, in addition to a robot or instead of one."""
    silent_s: int = 0
    """Seconds since the robot's last pose and speed, and thus the age of what is shown; 0 while they keep arriving."""
    robot: str = ""
    """The robot that this is about, as in `DriveInfo.robot`; empty if none subscribes to velocities."""
    robots: tuple[str, ...] = ()
    """The robots with odometry, each of which can be shown."""


@dataclass(frozen=True, slots=True)
class RobotStop:
    """A stop that holds the robot: the key that releases it, who made it, and why.

    `here`: this console made it. `by_node`: a node of the robot made it, not a person. `gone`: the process that made it
    has ended.
    """

    key: str
    holder: str = ""
    reason: str = ""
    here: bool = False
    by_node: bool = False
    gone: bool = False

    @property
    def who(self) -> str:
        """The holder of the stop; if its process has ended, a text that says so instead of giving the pid."""
        return f"{self.holder.rpartition(' (pid ')[0]} (gone)" if self.gone else self.holder


@dataclass(frozen=True, slots=True)
class DriveInfo:
    """The command chain with its velocities `asked`, `limited`, `final` and `actual` as (m/s, rad/s), None if unknown.

    `limited_by` names the parameter or rule that changed the command; it is empty if nothing did.
    """

    topic: str = ""
    robot: str = ""
    """The robot being driven, by its namespace."""
    robots: tuple[str, ...] = ()
    """All robots that subscribe to velocities."""
    others: frozenset[str] = frozenset()
    """The namespaces, each with a trailing slash, of robots that are not part of the driven one."""
    asked: tuple[float, float] | None = None
    limited: tuple[float, float] | None = None
    final: tuple[float, float] | None = None
    actual: tuple[float, float] | None = None
    silent_s: int = 0
    """Seconds since the robot last reported its actual velocity; 0 while it keeps reporting."""
    limited_by: str = ""
    stopped: bool = False
    """Whether a stop was requested, or a lock holds the robot."""
    stop_confirmed: bool = False
    """Whether every lock of the robot has acknowledged the stop; without a lock, whether one of its means of
    stopping has.
    """
    unsent: str = ""
    """Why a stop requested here could not be sent to any robot; empty if it was sent."""
    stop_holder: str = ""
    """Who made the oldest stop, according to the robot; `this console` for ourselves."""
    stop_reason: str = ""
    stopped_here: bool = False
    """Whether one of the stops is this console's."""
    own_stops: frozenset[str] = frozenset()
    """The ids of this console's stops, except those for key presses that have not been handled yet."""
    press_waits: bool = False
    """Whether the robot is held for a press of the stop key that has not been handled yet."""
    key_is_text: bool = False
    """Whether a text field has the focus, where the stop key is a letter."""
    key_only_holds: bool = False
    """Whether a question is open, during which the stop key only keeps the robot held."""
    stops: tuple[RobotStop, ...] = ()
    """Everybody's stops that the robot has acknowledged, oldest first."""
    lockable: bool = False
    """Whether the robot has an emergency stop that acknowledges requests."""
    unlocked: tuple[str, ...] = ()
    """The robots without such an emergency stop."""
    searching: bool = False
    """Whether the graph has been known too briefly to conclude that there is no other robot or no other lock."""
    held_by_means: str = ""
    """The configured means of stopping that has confirmed that it holds the robot; empty if none has."""
    means_news: str = ""
    """The result of the means of stopping tried last; after a release, which one could not be undone, and why."""
    steered_by: str = ""
    """Who has control, according to the robot."""
    refused: str = ""
    """Why this console can neither drive nor release the robot; empty if it can."""

    @property
    def key_releases(self) -> bool:
        """Whether the stop key, pressed now, would release this console's stops; otherwise it stops the robot.

        A stop is still reported while its release is on its way, and also for a key press that has not been handled
        yet.
        """
        only_holds = self.press_waits or self.key_is_text or self.key_only_holds or self.awaits_robot
        return bool(self.own_stops) and not only_holds

    @property
    def awaits_robot(self) -> bool:
        """Whether a stop was requested before any robot has been found; until then the stop key only sends it again."""
        return self.stopped and self.searching and not self.is_robot_known

    @property
    def is_robot_known(self) -> bool:
        """Whether anything is known that could receive a stop."""
        return bool(self.lockable or self.topic or self.robots or self.held_by_means or self.means_news)

    @property
    def nothing_to_stop(self) -> bool:
        """Whether there is no robot, so that nothing could have received a stop."""
        return not (self.is_robot_known or self.searching)
