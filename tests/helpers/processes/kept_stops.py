"""Ways in which a stop could get lost while a second program drives the robot, each checked by the witness.

`held_through` stops the robot, performs one of these ways, and returns how long the witness saw it move after that.
Then somebody else releases it, and it has to stay released when the same is done again.
"""

from __future__ import annotations

import contextlib
import signal
import subprocess
import time
from collections.abc import Callable, Iterator
from functools import partial

from processes.live_robot import DRIVER, RESTING, TIMEOUT_S, LiveRobot
from processes.losses import BRAKING, CONSOLE, WATCHED, Terminal, console, is_alive

RECORDED = ("/emergency_stop/request", "/emergency_stop/arbiter", "/emergency_stop/base")
Way = Callable[[LiveRobot, "Terminal | None"], None]


def _kill(*processes: subprocess.Popen[bytes]) -> None:
    for each in processes:
        each.kill()
    for each in processes:
        each.wait()


def monitor_killed(robot: LiveRobot, person: Terminal | None) -> None:
    """The safety monitor is killed (-9), and started again when that was seen."""
    _kill(robot.monitor)
    _wait(person, 1.0)
    robot.start_monitor()


def monitor_restarted(robot: LiveRobot, person: Terminal | None) -> None:
    """The safety monitor is killed and restarted at once."""
    _kill(robot.monitor)
    robot.start_monitor()


def base_restarted(robot: LiveRobot, person: Terminal | None) -> None:
    """The base is killed and restarted at once."""
    _kill(robot.base)
    robot.start_base()


def both_restarted(robot: LiveRobot, person: Terminal | None) -> None:
    """Both locks are killed before one of them is restarted."""
    _kill(robot.monitor, robot.base)
    robot.start_base()
    robot.start_monitor()


def both_ended(robot: LiveRobot, person: Terminal | None) -> None:
    """Both locks shut down cleanly, as with `down`, and are restarted."""
    for each in (robot.monitor, robot.base):
        each.send_signal(signal.SIGINT)
    for each in (robot.monitor, robot.base):
        each.wait(TIMEOUT_S)
    robot.start_base()
    robot.start_monitor()


def console_killed(robot: LiveRobot, person: Terminal | None) -> None:
    """The console that has stopped the robot is killed, then both locks."""
    if person is not None:
        person.process.kill()
        person.process.wait()
    both_restarted(robot, None)


def console_frozen(robot: LiveRobot, person: Terminal | None) -> None:
    """The console that has stopped the robot is frozen while both locks restart."""
    if person is not None:
        person.process.send_signal(signal.SIGSTOP)
    both_restarted(robot, None)
    _wait(None, WATCHED)
    if person is not None:
        person.process.send_signal(signal.SIGCONT)


def simulator_reset(robot: LiveRobot, person: Terminal | None) -> None:
    """The world is reset."""
    assert robot.typed("service", "call", "/reset", "std_srvs/srv/Trigger") == 0


def bag_played(robot: LiveRobot, person: Terminal | None) -> None:
    """All recorded stops and releases are replayed."""
    assert robot.typed("bag", "play", str(robot.folder / "stops"), "--topics", *RECORDED) == 0


WAYS: tuple[Way, ...] = (
    monitor_killed, monitor_restarted, base_restarted, both_restarted, both_ended, console_killed, console_frozen,
    simulator_reset, bag_played,
)  # fmt: skip


def held_through(way: Way, robot: LiveRobot) -> float:
    """How long (s) the robot moved after it was stopped; raises if it moves later, or if a stop comes back."""
    driver = robot.program(DRIVER, "cmd_vel")
    try:
        robot.drives()
        with recording(robot) if way is bag_played else contextlib.nullcontext():
            assert robot.typed("stop", "an earlier stop") == 0
            assert robot.typed("release") == 0
        robot.drives()
        with console(robot, CONSOLE) as person:
            person.type("!")
            person.read_until(lambda: b"held" in person.output, "the acknowledged stop")
            held = time.monotonic()
            way(robot, person)
            _wait(person, WATCHED)
            went_on = stands_since(robot, held)
            assert robot.typed("release", "--all") == 0
            robot.drives()
            way(robot, person)
            _wait(person, WATCHED)
            robot.typed("release")  # the stop that a node of the robot made because of its restart
            robot.drives()
    finally:
        driver.kill()
    return went_on


def stands_since(robot: LiveRobot, held: float) -> float:
    """How long (s) it moved after a time; raises if it moves longer than it needs to brake, or is not seen."""
    seen_until = time.monotonic()
    robot.until(lambda: any(moment > seen_until for moment, _ in robot.speeds(held)), "ground truth")
    moving = [moment - held for moment, speed in robot.speeds(held) if speed > RESTING]
    assert max(moving, default=0.0) <= BRAKING, f"it moved {len(moving)} times, last {max(moving):.2f} s after its stop"
    return max(moving, default=0.0)


@contextlib.contextmanager
def recording(robot: LiveRobot) -> Iterator[None]:
    """Record all messages about stops."""
    recorder = robot.console("bag", "record", "--output", str(robot.folder / "stops"), *RECORDED)
    _wait(None, WATCHED)
    yield
    _wait(None, 1.0)
    recorder.send_signal(signal.SIGINT)
    recorder.wait(TIMEOUT_S)


def _wait(person: Terminal | None, seconds: float) -> None:
    """Let time pass; a console's screen is read meanwhile, or its terminal would block."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if person is not None and is_alive(person.process.pid):
            person.drain(0.1)
        else:
            time.sleep(0.1)


def _named(way: Way) -> Callable[[LiveRobot], float]:
    made = partial(held_through, way)
    made.__name__ = way.__name__  # pyright: ignore[reportAttributeAccessIssue] -- a partial takes any attribute
    return made


KEPT = tuple(map(_named, WAYS))
"""The ways, each as what `witnessed_runs` runs."""
