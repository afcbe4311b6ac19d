"""The steering pane: drives the robot by keys like rqt_robot_steering, with a dead-man timeout."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from bot_console.tui import keymap
from bot_console.tui.console.model import ConsoleSnapshot
from bot_console.tui.console.robot.robot_model import DriveInfo
from bot_console.tui.panes.pane import Pane
from bot_console.tui.panes.steering.mouse import button, velocities
from bot_console.tui.panes.steering.state import (
    DEAD_MAN,
    DEADMAN_TIMES_S,
    LEFT,
    RATE_HZ,
    Steering,
    is_stopped_after_steering,
    limits_from_parameters,
    parse_limits,
    parse_rate,
    robot_of,
)
from bot_console.tui.panes.steering.view import lines, same_but_velocities
from bot_console.tui.text.redraw_interval import is_due
from bot_console.tui.widgets.picture import Picture
from bot_console.tui.widgets.prompt.line import Prompt
from bot_console.tui.widgets.prompt.question import Choice, Line, Option
from textual.app import ComposeResult
from textual.events import MouseDown, MouseEvent, MouseMove, MouseUp
from textual.timer import Timer

FIGURES_S = 0.5
"""Minimum seconds between two updates of the figures while this pane does not steer, so that they can be read."""
HELD = "The all-stop holds the robot; the line below shows how to release it."


class SteeringPane(Pane):
    """Drives the robot with keys and sliders, once armed."""

    TITLE = "Steering"
    HELP = (
        "Enter arms; then w s a d or the arrow keys drive, Shift takes ten steps, x and c zero one velocity and\n"
        "Space stops. While armed, only a person's commands count if a safety monitor chooses between them;\n"
        "without one the newest command wins, and the other nodes are named. If no key comes within the\n"
        "dead-man time, if you leave the pane, or if this console freezes or ends, the robot is stopped and locked:\n"
        "Enter resumes steering, ! returns control to its own program (h does so while armed). The limits are\n"
        "max_speed and turn_rate. Below you see what became of the command, and what has limited it."
    )
    BINDINGS = keymap.bindings("steering")

    clock: Callable[[], float] = staticmethod(time.monotonic)
    """A monotonic clock (s), replaced in tests."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.state = Steering()
        self._states: dict[str, Steering] = {}
        """Limits, dead-man time and command of each robot steered so far, by its name."""
        self._robot = ""
        self._snapshot = ConsoleSnapshot()
        self.can_focus = True
        self._dragging = self._on_pad = False
        self._wanted = ""
        """The topic to steer on as soon as a node subscribes to it."""
        self._rate: float | None = None
        """The initial rate (Hz) for every robot; None for the default."""
        self._repeating: Timer | None = None
        """Repeats the command if its rate is not that of the ticks."""
        self._figures, self._figures_at = DriveInfo(), float("-inf")
        """The velocities shown, and when (s) they were last updated."""

    def compose(self) -> ComposeResult:
        """The picture, and a prompt for limits."""
        yield Picture()
        yield Prompt(id="steering-prompt")

    @property
    def key_words(self) -> Mapping[str, str]:
        """What Enter does; nothing while someone else holds the robot."""
        if self.state.armed:
            return {"steering.arm": "Pause"}  # short, so that both turning keys fit into 80 columns
        if self._snapshot.drive.stopped:
            return {"steering.arm": "Resume" if self._own_stop else ""}
        return {}

    def focus_target(self) -> None:
        """Focus the pane itself."""
        self.focus()

    def show(self, snapshot: ConsoleSnapshot) -> None:
        """Follow the robot's state: disarm if it is stopped, silent or replaced; show what became of the command."""
        before, self._snapshot = self._snapshot, snapshot
        drive = snapshot.drive
        if drive.robot != self._robot:
            self._take_robot(drive.robot)
        if self._wanted and (robot := robot_of(self._wanted, drive.robots)):
            self._wanted = ""
            if robot != drive.robot:
                self._disarm()
                self.console.drive.choose(robot)
        whose = (drive.topic, drive.others)
        if snapshot.parameters is not before.parameters or whose != (before.drive.topic, before.drive.others):
            self._limit()
        if snapshot.drive.stopped and not before.drive.stopped and self.state.armed:
            self._stop_steering()
        if snapshot.link.silent_s and self.state.armed:
            self._disarm("Disarmed: the robot does not answer.")
        self._draw()

    def _take_robot(self, robot: str) -> None:
        """Switch to a robot and its settings; disarm first, so that keys meant for another one never move it."""
        if self._robot and self.state.armed:
            self._disarm("Disarmed: this pane now steers another robot." if robot else "Disarmed: the robot has left.")
        self._robot = robot
        if robot:
            self.state = self._states.setdefault(robot, self._fresh() if self._states else self.state)
            self._repeat_at_rate()

    def _fresh(self) -> Steering:
        return Steering() if self._rate is None else Steering(rate=self._rate)

    def steer_on(self, topic: str, rate: float | None) -> None:
        """Steer on a topic as soon as a node subscribes to it, and at a rate (Hz); empty or None changes nothing."""
        self._wanted = topic
        if rate is not None:
            self._rate = self.state.rate = rate
            self._repeat_at_rate()

    def _repeat_at_rate(self) -> None:
        if self._repeating is not None:
            self._repeating.stop()
            self._repeating = None
        if self.state.rate != RATE_HZ:
            self._repeating = self.set_interval(1.0 / self.state.rate, self._repeat)

    def _repeat(self) -> None:
        if self.state.armed:
            self._send()

    def action_rate(self) -> None:
        """Ask for the rate of the commands."""
        text = f"{self.state.rate:g}"
        self.ask(Line("commands per second, Hz (empty: 10)", self._rate_typed, text=text, check=_rate_problem))

    def _rate_typed(self, text: str) -> None:
        self.state.rate = parse_rate(text)
        self._repeat_at_rate()
        self._draw()

    def _draw(self) -> None:
        picture = self.query_one(Picture)
        width, height = picture.size
        left, figures = self.state.left(self.clock()), self._shown_figures()
        picture.set_lines(lines(self.state, self._snapshot.drive, left, width, height, self._others(), figures))
        self.set_class(self.state.armed, "armed")
        self.keys_changed()

    def _shown_figures(self) -> DriveInfo:
        """The velocities to show; while this pane does not steer, they stay long enough to be read."""
        drive, held = self._snapshot.drive, self._figures
        if self.state.armed or self._are_figures_due() or not same_but_velocities(drive, held):
            self._figures, self._figures_at = drive, self.clock()
        return self._figures

    def _are_figures_due(self) -> bool:
        return is_due(self._figures_at, self.clock(), FIGURES_S)

    def _others(self) -> list[str]:
        """Other nodes that publish commands on this pane's topic."""
        topic = self._snapshot.drive.topic
        nodes = (each for each in self._snapshot.graph.nodes if not each.hidden)
        return [each.name for each in nodes if any(end.name == topic for end in each.publishers)]

    def _limit(self) -> None:
        """Apply the typed limits, or else those from the robot's parameters."""
        trees, drive = self._snapshot.parameters.values(), self._snapshot.drive
        self.state.limit(self.state.typed or limits_from_parameters(trees, drive.topic, drive.others))

    def action_limits(self) -> None:
        """Ask for limits."""
        now = self.state.typed
        text = f"{now[0]:g} {now[1]:g}" if now else ""
        label = "limits m/s rad/s (empty: from the parameters)"
        self.ask(Line(label, self._limits_typed, text=text, check=_limits_problem))

    def _limits_typed(self, text: str) -> None:
        self.state.typed = parse_limits(text)
        self._limit()
        self._draw()

    def on_mouse_down(self, event: MouseDown) -> None:
        """Set a velocity by a slider, or both by the pad; handle a button."""
        picture = self.query_one(Picture)
        at = event.screen_offset - picture.region.offset
        pressed = button(picture.lines, at.x, at.y)
        if pressed is not None:
            self._press(*pressed)
            return
        self._dragging = self._aim(event)
        if self._dragging:
            self.capture_mouse()

    def _press(self, axis: int, step: int) -> None:
        if step:
            self.action_steer(*((step, 0) if axis == 0 else (0, step)), steps=1)
        else:
            self.action_zero_axis(axis)

    def on_mouse_move(self, event: MouseMove) -> None:
        """Follow the mouse."""
        if self._dragging:
            self._aim(event)

    def on_mouse_up(self, event: MouseUp) -> None:
        """Release; the pad returns to zero like a joystick."""
        self.release_mouse()
        if self._dragging and self._on_pad and self.state.armed:
            self.action_zero()
        self._dragging = self._on_pad = False

    def _aim(self, event: MouseEvent) -> bool:
        picture = self.query_one(Picture)
        at = event.screen_offset - picture.region.offset
        found = velocities(picture.lines, at.x, at.y, self.state.greatest)
        if found is None or not self._ready():
            return False
        linear, angular, self._on_pad = found
        self.state.aim(linear, angular, self.clock())
        self._send()
        self._draw()
        return True

    def on_picture_resized(self, event: Picture.Resized) -> None:
        """Draw for the new size."""
        event.stop()
        self._draw()

    def tick(self) -> None:
        """Repeat the command; stop if no key was pressed within the dead-man time, or the pane has lost the focus."""
        if self.state.armed and not (self.has_focus and self.host.screen is self.screen):
            self._disarm("Disarmed: another pane has the keyboard.")
        if self.state.armed and (self._repeating is None or self.state.expires(self.clock())):
            self._send()
        if self.state.armed:
            self.console.drive.steer(True)
        is_late = self._figures is not self._snapshot.drive and self._are_figures_due()
        if self.display and (self.state.armed or is_late):
            self._draw()

    def _send(self) -> None:
        armed = self.state.armed
        command = self.state.command(self.clock())
        if command is not None:
            self.console.drive.move(*command)
        if armed and self.state.expired:
            self._stand(DEAD_MAN)
            self._draw()

    def _stand(self, why: str) -> None:
        """Stop the robot before releasing the steering, so that its own program does not drive in between."""
        self.console.drive.stop(True, why)
        self.console.drive.steer(False)

    def _stop_steering(self) -> None:
        """Stop steering, with a zero velocity."""
        self.state.disarm()
        self._send()
        self.console.drive.steer(False)

    def _disarm(self, why: str = "") -> None:
        if self.state.armed:
            self.state.disarm()
            self._send()
            self._stand(LEFT)
            if why:
                self.notify(why)
        self._draw()

    def on_blur(self) -> None:
        """Disarm, since the pane has lost the focus."""
        self._disarm()

    def on_unmount(self) -> None:
        """Disarm with a zero velocity on exit; a steered robot stays stopped."""
        self.detach()

    def detach(self) -> None:
        """Disarm with a zero velocity; a steered robot stays stopped."""
        if self.state.armed:
            self.state.disarm()
            self._send()
            self._stand(LEFT)

    def _ready(self) -> bool:
        if self._snapshot.drive.stopped:
            self.notify(HELD, severity="warning")
        elif not self.state.armed:
            self.notify("Steering is not armed; Enter arms it.", severity="warning")
        else:
            return True
        return False

    def action_arm(self) -> None:
        """Arm, or disarm."""
        if self.state.armed:
            self._disarm()
        elif self._snapshot.drive.refused:
            self.notify(self._snapshot.drive.refused, severity="warning")
        elif not self._snapshot.drive.topic:
            self.notify(
                "No node subscribes to cmd_vel or cmd_vel_teleop: there is nothing to steer.", severity="warning"
            )
        elif self._snapshot.drive.stopped and not self._own_stop:
            self.notify(HELD, severity="warning")
        else:
            self._arm()

    @property
    def _own_stop(self) -> bool:
        """Whether this pane stopped the robot, so that Enter may resume steering."""
        return is_stopped_after_steering(self._snapshot.drive)

    def _arm(self) -> None:
        """Take the steering before releasing the stop, so that the robot stands still until a key moves it."""
        self.console.drive.steer(True)
        if self._snapshot.drive.stopped:
            self.console.drive.stop(False)
        self._snapshot = self.console.snapshot()
        self.state.arm(self.clock())
        self._draw()

    def action_hand_back(self) -> None:
        """Let the robot's own program drive again."""
        if self.state.armed:
            self._stop_steering()
            self._draw()
        elif self._own_stop:
            self.console.drive.stop(False)

    def action_disarm(self) -> None:
        """Disarm with a zero velocity."""
        self._disarm()

    def action_steer(self, linear: int, angular: int, steps: int) -> None:
        """Change the command and send it immediately."""
        if self._ready():
            self.state.steer(linear, angular, steps, self.clock())
            self._send()
            self._draw()

    def action_slide(self, steps: int) -> None:
        """Change the sideways velocity and send it immediately."""
        if self._ready():
            self.state.slide(steps, self.clock())
            self._send()
            self._draw()

    def action_zero_axis(self, axis: int) -> None:
        """Zero one velocity."""
        if self._ready():
            self.state.zero_axis(axis, self.clock())
            self._send()
            self._draw()

    def action_zero(self) -> None:
        """Stop the robot, armed or not."""
        self.state.zero()
        self._send()
        self._draw()

    def action_next_robot(self) -> None:
        """Steer another robot; the current one is released first."""
        drive = self._snapshot.drive
        if len(drive.robots) < 2:
            self.notify("No other topic here takes commands.", severity="warning")
            return
        self._disarm()
        at = drive.robots.index(drive.robot) if drive.robot in drive.robots else -1
        self.console.drive.choose(drive.robots[(at + 1) % len(drive.robots)])

    def action_topic(self) -> None:
        """Choose the command topic by name; the robot steered now is released first."""
        self._disarm()
        robots = self._snapshot.drive.robots

        def find(typed: str) -> Sequence[Option]:
            found = [each for each in robots if typed.strip() in each]
            named = robot_of(typed.strip(), robots)
            return [Option(each) for each in found or ([named] if named else [])]

        empty = "No topic with this name takes velocity commands."
        choose = self.console.drive.choose
        self.ask(Choice("Steer which robot or topic?", choose, find=find, hint="type part of its name", empty=empty))

    def action_deadman(self) -> None:
        """Switch to the next dead-man time."""
        times = DEADMAN_TIMES_S
        self.state.deadman = times[(times.index(self.state.deadman) + 1) % len(times)]
        self._draw()


def _rate_problem(text: str) -> str:
    try:
        parse_rate(text)
    except ValueError as error:
        return str(error)
    return ""


def _limits_problem(text: str) -> str:
    try:
        parse_limits(text)
    except ValueError as error:
        return str(error)
    return ""
