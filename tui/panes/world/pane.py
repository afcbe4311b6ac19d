"""The world pane: map, robot, trail and LIDAR hits; or a turtlesim field."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

from bot_console.tui import keymap
from bot_console.tui.console.model import ConsoleSnapshot
from bot_console.tui.console.robot.robot_model import Pose, TurtleField, WorldInfo
from bot_console.tui.format import clock_text, figure
from bot_console.tui.panes.pane import Pane
from bot_console.tui.text.sanitize import sanitize
from bot_console.tui.widgets.live_figures import LiveFigures
from bot_console.tui.widgets.picture import Picture
from bot_console.tui.widgets.placeholder import Placeholder
from bot_console.tui.widgets.prompt.line import Prompt
from rich.cells import cell_len
from textual.app import ComposeResult

if TYPE_CHECKING:
    from bot_console.tui.panes.world.map_drawing import WorldDrawing
    from bot_console.tui.panes.world.turtle_field import FieldDrawing

ZOOMS = (1.0, 2.0, 4.0, 8.0)


DRAWINGS_PER_HITS = 3
"""The LIDAR hits are updated once in this many drawings."""

EMPTY = Placeholder(
    "The robot on its map: there is no map and no pose yet (no OccupancyGrid, no Odometry).",
    (("9", "See the topics"), ("8", "Start nodes"), ("?", "Help")),
)


class WorldMap(Picture):
    """The drawing of a robot on its map, or of a turtlesim field."""

    def __init__(self) -> None:
        super().__init__()
        self._world = WorldInfo()
        self._drawing: WorldDrawing | None = None
        self._field_drawing: FieldDrawing | None = None
        self._reported: object = None
        """What the lines show, as returned by `visible_content`; None if they show no map."""
        self._age = -1
        self._field = ""
        """The node of the chosen turtlesim field; empty for a robot's place."""
        self.zoom = 1.0
        self.scale = ""
        self.scale_within: Callable[[int], str] = lambda room: ""
        """Returns the scale in at most a number of cells."""

    def show(self, world: WorldInfo) -> None:
        """Draw a world."""
        # Ranges are noisy, so hits flicker all over the map and cost most of the bytes.
        self._age = (self._age + 1) % DRAWINGS_PER_HITS
        keep = self._age and self._world.hits and world.hits
        self._world = replace(world, hits=self._world.hits) if keep else world
        self.draw()

    @property
    def places(self) -> list[str | TurtleField]:
        """The places that can be shown: each robot, by its name, and each turtlesim field."""
        world = self._world
        here = [world.robot] if world.pose or world.map or not world.fields else []
        return [*(world.robots if len(world.robots) > 1 else here), *world.fields]

    @property
    def place(self) -> str | TurtleField:
        """The shown place: the steered robot's, unless a field was chosen or there are only fields."""
        world = self._world
        chosen = next((each for each in world.fields if each.node == self._field), None)
        first = self.places[0]
        return chosen or (first if isinstance(first, TurtleField) else world.robot)

    @property
    def field(self) -> TurtleField | None:
        """The shown field; None for a robot's place."""
        place = self.place
        return place if isinstance(place, TurtleField) else None

    def next_place(self) -> str:
        """Go to the next of the `places`; returns the robot to show, or an empty text for a field."""
        places, now = self.places, self.place
        place = places[(places.index(now) + 1) % len(places) if now in places else 0]
        self._field = place.node if isinstance(place, TurtleField) else ""
        self.draw()
        return "" if isinstance(place, TurtleField) else place

    def draw(self) -> None:
        """Draw the world in the current size."""
        width, height = self.size
        if width < 4 or height < 2:
            return
        if self.field:
            self._reported = None
            from bot_console.tui.panes.world.turtle_field import FieldDrawing

            self._field_drawing = self._field_drawing or FieldDrawing()
            self.set_lines(self._field_drawing.rows(self.field, width, height))
            return
        if not (self._world.map or self._world.pose or self._world.trail):
            self._reported = None
            self.set_lines(())
            return
        # NumPy is imported after the first frame: it would take a third of the start-up time.
        from bot_console.tui.panes.world.map_drawing import WorldDrawing, following_window, scale_text, visible_content

        self._drawing = self._drawing or WorldDrawing()
        window = following_window(self._world, width, height, self.zoom)
        reported = visible_content(self._world, window, width, height)
        if reported != self._reported:
            self._reported = reported
            self.set_lines(self._drawing.rows(self._world, window, width, height))
            self.scale = scale_text(window, width)
            self.scale_within = partial(scale_text, window, width)


class WorldPane(Pane):
    """The robot in its world."""

    TITLE = "World"
    HELP = (
        "The map, the robot as an arrow, where it has been, and where its LIDAR beams end. + zooms in, f shows all. "
        "While another moment is chosen (in Plot, Logs or History), the robot is shown where it was then. "
        "Of several robots the steered one is shown: n takes the next, and Steering and the status line follow. "
        "A turtlesim field is shown with its turtles and what they draw; n goes there after the robots."
    )
    BINDINGS = keymap.bindings("world")
    DEFAULT_CSS = """
    WorldPane #world-facts { height: 1; padding: 0 1; color: $text-muted; background: $surface; }
    """

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._world: WorldInfo | None = None
        self._then: Pose | None = None
        """Where the robot was at the time cursor; None if that is at now, or the pose is unknown."""
        self._snapshot = ConsoleSnapshot()
        self.can_focus = True

    def compose(self) -> ComposeResult:
        """The map, a line of facts, and a prompt."""
        yield WorldMap()
        yield LiveFigures(id="world-facts")
        yield Prompt(id="world-prompt")

    def focus_target(self) -> None:
        """Focus the pane itself."""
        self.focus()

    def show(self, snapshot: ConsoleSnapshot) -> None:
        """Redraw the world if it is a different object."""
        before, self._snapshot = self._snapshot, snapshot
        if snapshot.problem != before.problem or snapshot.capabilities is not before.capabilities:
            self._facts()
        if snapshot.world is not self._world:
            self._world = snapshot.world
            self._draw(live=True)

    def tick(self) -> None:
        """Show figures that are due."""
        if self.display:
            self.query_one(LiveFigures).heartbeat()

    def _draw(self, live: bool = False) -> None:
        world = self._world or WorldInfo()
        if self._then is not None:
            world = replace(world, pose=self._then, hits=())
        self.query_one(WorldMap).show(world)
        self._facts(live)

    def time_moved(self, stamp: int | None) -> None:
        """Show where the robot was at the moment to which the time cursor has moved."""
        self._then = None if stamp is None else self.console.drive.pose_at(stamp)
        if not self.is_ending:
            self._draw()

    def on_picture_resized(self, event: Picture.Resized) -> None:
        """Draw for the new size."""
        event.stop()
        self.query_one(WorldMap).draw()
        self._facts()

    def _facts(self, live: bool = False) -> None:
        snapshot, world = self._snapshot, self._snapshot.world
        drawn = self.query_one(WorldMap)
        drawn.show_placeholder(EMPTY)
        more = f"  n: next of {len(drawn.places)} places" if len(drawn.places) > 1 else ""
        if drawn.field:
            text = _turtles_text(drawn.field) + more
        elif world.pose is None and world.map is None:
            text = snapshot.problem or snapshot.capabilities.world
        else:
            pose = self._then or world.pose
            near = "free" if world.nearest is None else f"{figure(world.nearest)} m"
            where = f"x {pose.x:6.1f}  y {pose.y:6.1f}" if pose else "pose unknown"
            speed = f"SILENT for {world.silent_s} s" if world.silent_s else f"{figure(world.speed, '+')} m/s"
            whose = f"{sanitize(world.robot)}  " if len(world.robots) > 1 else ""
            where = f"{whose}{where}"
            text = f"{where}  {speed}  nearest {near}  "
            width = self.query_one(LiveFigures).content_size.width
            if width and cell_len(text + more) > width:  # speed and distance matter more than the position
                text = f"{speed}  nearest {near}  "
            room = width - cell_len(text + more)
            text += (drawn.scale if len(drawn.scale) <= room or not width else drawn.scale_within(room)) + more
            stamp = self.time_cursor.stamp
            if stamp is not None:
                known = f"{where}  " if self._then else "the robot's position then is unknown  "
                text = f"◆ {clock_text(stamp)}  {known}{drawn.scale}{more}"
        facts = self.query_one(LiveFigures)
        (facts.show_live if live else facts.show_now)(text)

    def action_next_place(self) -> None:
        """Go to the next robot or turtlesim field."""
        robot = self.query_one(WorldMap).next_place()
        if robot and robot != self._snapshot.world.robot:
            self.console.drive.choose(robot)
        self._facts()

    def action_zoom_map(self, step: int) -> None:
        """Zoom in or out."""
        drawn = self.query_one(WorldMap)
        at = ZOOMS.index(drawn.zoom)
        drawn.zoom = ZOOMS[min(max(0, at + step), len(ZOOMS) - 1)]
        drawn.draw()
        self._facts()

    def action_fit(self) -> None:
        """Switch between the whole map and a closer view of the robot."""
        drawn = self.query_one(WorldMap)
        drawn.zoom = 1.0 if drawn.zoom > 1 else 4.0
        drawn.draw()
        self._facts()


def _turtles_text(field: TurtleField) -> str:
    """A line on a field with its turtles in order, as the line may be cut."""
    each = (
        f"{turtle.name} {figure(turtle.pose.x)}, {figure(turtle.pose.y)} {figure(turtle.speed)} m/s"
        for turtle in field.turtles
    )
    return f"{field.node}: " + "; ".join(each)
