"""Checks that a stop holds, and that its release lasts, whatever happens; the witness is the judge.

`held_through` stops a robot that a second program drives, disturbs it as a `StopScenario` says, and checks that the
robot stands. Then somebody else releases it, and it has to drive on through the same disturbance. The scenarios are in
`ways_to_lose_stops.py`.
"""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass

from emulator import last_screen, screen_of

from processes.live_robot import MOVING, RESTING, TIMEOUT_S, LiveRobot
from processes.losses import BRAKING, WATCHED, Terminal, console, is_alive

FIRST_SCREEN = "? Help"
"""The text on the console's screen before it is connected; a stop can be requested from then on."""
Disturbance = Callable[[LiveRobot, Terminal], AbstractContextManager[None]]
"""A disturbance of a stopped robot: it begins before the block, and is over after it."""


def press(robot: LiveRobot, person: Terminal) -> None:
    """Press the stop key in the console."""
    person.type("!")


@contextlib.contextmanager
def unchanged(robot: LiveRobot) -> Iterator[Sequence[str]]:
    """Leave the robot unchanged; yield the arguments of a console on this machine."""
    yield robot.attach


@contextlib.contextmanager
def unrecorded(robot: LiveRobot) -> Iterator[None]:
    """Do nothing around an earlier stop and its release."""
    yield


@dataclass(frozen=True, kw_only=True)
class StopScenario:
    """One way in which a stop could get lost.

    `prepare` changes the robot and yields the arguments of the console. `beside_earlier_stop` surrounds an earlier stop
    and release by the same console. `stop` stops the robot. With `releases_within`, the release that has to last also
    comes during the disturbance. `in_background`: the robot was started by `bot-console up`.
    """

    name: str
    disturb: Disturbance
    prepare: Callable[[LiveRobot], AbstractContextManager[Sequence[str]]] = unchanged
    beside_earlier_stop: Callable[[LiveRobot], AbstractContextManager[None]] = unrecorded
    stop: Callable[[LiveRobot, Terminal], None] = press
    releases_within: bool = False
    in_background: bool = False


def held_through(scenario: StopScenario, robot: LiveRobot) -> float:
    """Return how long (s) the robot moved on after the stop; raise if it moves later, or if a released stop returns."""
    with contextlib.ExitStack() as ended_last:
        words = ended_last.enter_context(scenario.prepare(robot))
        driver = robot.second_driver()
        ended_last.callback(driver.wait)
        ended_last.callback(driver.kill)
        robot.drives()
        person = ended_last.enter_context(console(robot, words, FIRST_SCREEN))
        with scenario.beside_earlier_stop(robot):
            _stop_and_release(robot, person)
        scenario.stop(robot, person)
        held = time.monotonic()
        _until_rests(robot, person)
        with scenario.disturb(robot, person):
            wait(person, WATCHED)
            stands_since(robot, held)
        wait(person, WATCHED)
        went_on = stands_since(robot, held)
        release(robot)
        with scenario.disturb(robot, person):
            wait(person, WATCHED)
        wait(person, WATCHED)
        drives_after_restart(robot, person)
        if scenario.releases_within:
            scenario.stop(robot, person)
            _until_rests(robot, person)
            with scenario.disturb(robot, person):
                wait(person, WATCHED)
                drives_after_restart(robot, person, "--all")
            wait(person, WATCHED)
            drives_after_restart(robot, person)
    return went_on


def _stop_and_release(robot: LiveRobot, person: Terminal) -> None:
    """Press the stop key, and press it again when the robot stands and the screen says that the key releases it.

    On a busy machine the console may already show a stop although the key has not been handled: then another press
    stops
    the robot once more.
    """
    shows = screen_of(person)
    person.type("!")
    _until_rests(robot, person)
    deadline = time.monotonic() + TIMEOUT_S
    while not any(speed > MOVING for _, speed in robot.speeds(time.monotonic() - 0.5)):
        assert time.monotonic() < deadline, f"it does not drive again:\n{last_screen(person)}"
        if shows("! releases"):
            person.type("!")
        wait(person, WATCHED)


def _until_rests(robot: LiveRobot, person: Terminal) -> None:
    """Wait until the witness has seen the robot stand for half a second."""

    def rests() -> bool:
        seen = robot.speeds(time.monotonic() - 0.5)
        return _drained(person) and bool(seen) and all(speed <= RESTING for _, speed in seen)

    robot.until(rests, "robot at rest")


def _drained(person: Terminal) -> bool:
    person.drain(0.05)
    return True


def release(robot: LiveRobot) -> None:
    """Release everybody's stops from a shell, and wait until the robot drives."""
    assert robot.run_cli("release", "--all") == 0
    robot.drives()


def drives_after_restart(robot: LiveRobot, person: Terminal | None, *options: str) -> None:
    """Release the stops that nodes have made because of a restart, once for each late start, until the robot drives.

    Without `--all` this releases no person's stop. The console's screen is read meanwhile: a console that cannot write
    does not handle its keys.
    """
    deadline = time.monotonic() + TIMEOUT_S
    while True:
        releasing = robot.console("release", *options)
        while releasing.poll() is None:
            wait(person, 0.1)
        began = time.monotonic()
        while time.monotonic() < began + WATCHED:
            if any(speed > MOVING for _, speed in robot.speeds(began)):
                return
            wait(person, 0.1)
        assert time.monotonic() < deadline, f"the stop came back: {robot.answer('status')} {robot.log()[-2000:]}"


def stands_since(robot: LiveRobot, held: float) -> float:
    """How long (s) the robot moved on after a moment; raises if it moves longer than braking takes, or is not seen."""
    seen_until = time.monotonic()
    robot.until(lambda: any(moment > seen_until for moment, _ in robot.speeds(held)), "ground truth")
    moving = [moment - held for moment, speed in robot.speeds(held) if speed > RESTING]
    assert max(moving, default=0.0) <= BRAKING, f"it moved {len(moving)} times, last {max(moving):.2f} s after its stop"
    return max(moving, default=0.0)


def wait(person: Terminal | None, seconds: float) -> None:
    """Let time pass; the console's screen is read meanwhile, since its terminal would block otherwise."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if person is not None and is_alive(person.process.pid):
            person.drain(0.1)
        else:
            time.sleep(0.1)
