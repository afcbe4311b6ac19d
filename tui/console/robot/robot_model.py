"""What is known about the robot: its surroundings, and the path of its velocity commands. Standard library only.

Distances are m, angles rad, speeds m/s and rad/s.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


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
    """A turtle of `turtlesim`: its pose (m, rad), velocity (m/s, rad/s), and a trail where its drawing is unknown."""

    name: str
    pose: Pose
    speed: float = 0.0
    turn: float = 0.0
    trail: tuple[tuple[float, float], ...] = ()


@dataclass(frozen=True, slots=True)
class Drawing:
    """What turtles have drawn: rows, from the top, of red, green, blue and 255 where something is drawn, else 0.

    Where nothing is drawn, the colour is the background's.
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
    """What is known about the surroundings: map, robot, trail, and the ends of the LIDAR beams (x, y in m)."""

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
    """For how many seconds the robot has told no pose and speed; 0 while it does. What is known is then that old."""
    robot: str = ""
    """Which robot this is about, as `DriveInfo.robot`; empty where none listens for velocities."""
    robots: tuple[str, ...] = ()
    """The robots that have odometry of their own, each of which can be shown."""


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
        """Its holder; where that process has ended, the text says so instead of giving its number."""
        return f"{self.holder.rpartition(' (pid ')[0]} (gone)" if self.gone else self.holder


@dataclass(frozen=True, slots=True)
class DriveInfo:
    """The command chain, each as (m/s, rad/s) or None when unknown: asked, limited, final, actual.

    `limited_by` names, in words, the parameter or rule that changed the command; it is empty when nothing did.
    """

    topic: str = ""
    robot: str = ""
    """Which robot is steered, by its namespace."""
    robots: tuple[str, ...] = ()
    """All that listen for velocities."""
    others: frozenset[str] = frozenset()
    """Namespaces, each with a slash at its end, of robots that are not part of the steered one."""
    armed: bool = False
    asked: tuple[float, float] | None = None
    limited: tuple[float, float] | None = None
    final: tuple[float, float] | None = None
    actual: tuple[float, float] | None = None
    silent_s: int = 0
    """For how many seconds the robot has not told its actual velocity; 0 while it does."""
    limited_by: str = ""
    stopped: bool = False
    """Whether a stop was asked for, or a lock holds the robot."""
    stop_confirmed: bool = False
    """Whether every lock of the robot has acknowledged that it holds; without a lock, whether a means has."""
    unsent: str = ""
    """Why a stop that was asked for here has been sent to nobody; empty where it was sent."""
    stop_holder: str = ""
    """Who has held it longest, as the robot says; `this console` for ourselves."""
    stop_reason: str = ""
    stopped_here: bool = False
    """Whether one of the stops is this console's."""
    stops: tuple[RobotStop, ...] = ()
    """Everybody's stops that the robot has acknowledged, the oldest first."""
    lockable: bool = False
    """Whether the robot has an emergency stop that acknowledges."""
    unlocked: tuple[str, ...] = ()
    """The robots that have no emergency stop that acknowledges."""
    held_by_means: str = ""
    """Which configured means holds them, by its own word; empty if none does."""
    means_news: str = ""
    """What came of the means that was tried last; after a release, which means could not be undone and why."""
    steered_by: str = ""
    """Who holds the steering, as the robot says."""
    refused: str = ""
    """Why nothing is steered or released from this console; empty where it may."""

    @property
    def nothing_to_stop(self) -> bool:
        """Whether no robot is known, so that nobody could have received a stop."""
        return not (self.lockable or self.topic or self.robots or self.held_by_means or self.means_news)
