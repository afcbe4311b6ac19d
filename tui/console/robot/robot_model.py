"""The robot as the console knows it: its surroundings, and the path of its velocity commands. Standard library only.

Distances are m, angles rad, speeds m/s and rad/s.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

STEERING_RATES_HZ = (1.0, 50.0)
"""The lowest and the highest rate at which a person's commands can be sent."""


@dataclass(frozen=True, slots=True)
class Pose:
    """A pose in the plane: m, m, rad counter-clockwise from +x."""

    x: float = 0.0
    y: float = 0.0
    heading: float = 0.0


@dataclass(frozen=True, slots=True)
class GridMap:
    """An occupancy grid (`nav_msgs/OccupancyGrid`): row-major from the lower left, 0..100, 255 unknown."""

    width: int
    height: int
    resolution: float
    origin: Pose
    cells: bytes


@dataclass(frozen=True, slots=True)
class Turtle:
    """A turtle of `turtlesim`: its pose (m, rad), velocity (m/s, rad/s), and a trail if its drawing is unknown."""

    name: str
    pose: Pose
    speed: float = 0.0
    turn: float = 0.0
    trail: tuple[tuple[float, float], ...] = ()


@dataclass(frozen=True, slots=True)
class Drawing:
    """The drawing of turtles, as RGBA rows from the top; alpha is 255 where something is drawn, else 0.

    Where nothing is drawn, the background's colour is shown.
    """

    width: int
    height: int
    pixels: bytes


@dataclass(frozen=True, slots=True)
class TurtleField:
    """The field of a `turtlesim` node with the turtles on it."""

    node: str
    turtles: tuple[Turtle, ...] = ()
    drawing: Drawing | None = None


@dataclass(frozen=True, slots=True)
class WorldInfo:
    """The surroundings as far as known: map, robot, trail, and the end points of the LIDAR beams (x, y in m)."""

    map: GridMap | None = None
    pose: Pose | None = None
    trail: tuple[tuple[float, float], ...] = ()
    hits: Sequence[tuple[float, float]] = ()
    goal: tuple[float, float] | None = None
    speed: float = 0.0
    turn: float = 0.0
    nearest: float | None = None
    fields: tuple[TurtleField, ...] = ()
    """Fields with turtles, beside or instead of a robot."""
    silent_s: int = 0
    """Seconds since the robot's last pose and speed; 0 while they keep coming. Everything shown is that old."""
    robot: str = ""
    """The robot this is about, as `DriveInfo.robot`; empty if none subscribes to velocities."""
    robots: tuple[str, ...] = ()
    """The robots with odometry, each of which can be shown."""


@dataclass(frozen=True, slots=True)
class RobotStop:
    """One of the stops that hold the robot: the key that releases it, who made it, and why.

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
        """Its holder; if that process has ended, the text says so instead of giving its pid."""
        return f"{self.holder.rpartition(' (pid ')[0]} (gone)" if self.gone else self.holder


@dataclass(frozen=True, slots=True)
class DriveInfo:
    """The command chain, each velocity as (m/s, rad/s) or None if unknown: asked, limited, final, actual.

    `limited_by` names the parameter or rule that changed the command; it is empty if nothing did.
    """

    topic: str = ""
    robot: str = ""
    """The robot being driven, by its namespace."""
    robots: tuple[str, ...] = ()
    """All robots that subscribe to velocities."""
    others: frozenset[str] = frozenset()
    """Namespaces, each with a slash at its end, of robots that are not part of the driven one."""
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
    """Why a stop requested here could not be sent to anybody; empty if it was sent."""
    stop_holder: str = ""
    """Who has held it longest, according to the robot; `this console` for ourselves."""
    stop_reason: str = ""
    stopped_here: bool = False
    """Whether one of the stops is this console's."""
    own_stops: frozenset[str] = frozenset()
    """The ids of the stops that this console has requested, except those for key presses that are not handled yet."""
    press_waits: bool = False
    """Whether the robot is held for a press of the stop key that is not handled yet."""
    key_is_text: bool = False
    """Whether a text field has the focus, in which the stop key is a letter."""
    key_only_holds: bool = False
    """Whether a question is open during which the stop key keeps the robot held."""
    stops: tuple[RobotStop, ...] = ()
    """Everybody's stops that the robot has acknowledged, the oldest first."""
    lockable: bool = False
    """Whether the robot has an emergency stop that acknowledges requests."""
    unlocked: tuple[str, ...] = ()
    """The robots that have no such emergency stop."""
    searching: bool = False
    """Whether the graph has not been known for long enough to tell that there is no other robot, or no other lock."""
    held_by_means: str = ""
    """The configured means of stopping that reports that it holds them; empty if none does."""
    means_news: str = ""
    """The result of the means of stopping tried last; after a release, which one could not be undone and why."""
    steered_by: str = ""
    """Who has control, according to the robot."""
    refused: str = ""
    """Why the robot can be neither driven nor released from this console; empty if it can."""

    @property
    def key_releases(self) -> bool:
        """Whether the stop key, pressed now, would release this console's stops; otherwise it stops the robot.

        A stop is still reported while its release is on its way, and also for a key press that is not handled yet.
        """
        only_holds = self.press_waits or self.key_is_text or self.key_only_holds or self.awaits_robot
        return bool(self.own_stops) and not only_holds

    @property
    def awaits_robot(self) -> bool:
        """Whether a stop is requested before any robot has been found; until then the key only sends it again."""
        return self.stopped and self.searching and not self.is_robot_known

    @property
    def is_robot_known(self) -> bool:
        """Whether there is anything that could receive a stop, as far as is known."""
        return bool(self.lockable or self.topic or self.robots or self.held_by_means or self.means_news)

    @property
    def nothing_to_stop(self) -> bool:
        """Whether there is no robot, so that nobody could have received a stop."""
        return not (self.is_robot_known or self.searching)
