"""The port for the robot: steers it through the gate, and stops it in every state of the console.

A stop that is requested before there is a link to the robot is kept, and sent once there is a link. After the console
has closed, a stop opens the link again until the robot confirms it.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from bot_console.tui.console.command_gate import CLOSED, STARTING, Gate
from bot_console.tui.console.model import LinkInfo
from bot_console.tui.console.robot.robot_model import DriveInfo, Pose, WorldInfo

if TYPE_CHECKING:
    from bot_console.tui.console.robot.drive_link import DriveLink
    from bot_console.tui.console.robot.drive_node import DriveNode
    from bot_console.tui.console.robot.pose_and_trail import WorldWatch

LAST_ZERO_TIMEOUT_S = 0.15
"""Seconds allowed for the final zero Twist, or the lock, to reach the robot before anything is shut down."""
CONFIRMATION_POLL_S = 0.1
RECONNECT_PAUSE_S = 1.0
NO_WORLD = WorldInfo()
UNSENT = frozenset(["unsent"])
"""A placeholder for the id of a stop, which is assigned when the stop is sent."""
IDLE = DriveInfo()
NOT_YET = DriveInfo(
    stopped=True,
    stopped_here=True,
    own_stops=UNSENT,
    searching=True,
    unsent="still connecting; it is sent once connected",
)
NOT_CONNECTED = replace(NOT_YET, unsent="not connected; run bot-console stop in another terminal")


class RobotDrive:
    """Steers and stops the robot. Methods may be called from any thread."""

    def __init__(
        self,
        gate: Gate,
        connect: Callable[[], DriveNode],
        *,
        network: Callable[[], LinkInfo],
        on_stop: Callable[[], None],
        report: Callable[[str], None],
    ) -> None:
        """`connect` opens a link to the robot; `network` returns the state of the network.

        `on_stop` ends what would drive the robot again after its release; `report` receives refusals of requests that
        return no answer.
        """
        self._gate = gate
        self._connect = connect
        self._network = network
        self._on_stop = on_stop
        self._report = report
        # Reentrant: a signal that ends the console also stops the robot, even in the middle of a stop.
        self._lock = threading.RLock()
        self._node: DriveNode | None = None
        """The node that stops the robot even if everything else has failed."""
        self._link: DriveLink | None = None
        """The link of that node; it still provides its last state after the node has closed."""
        self._world: WorldWatch | None = None
        self._requests: tuple[tuple[bool, str], ...] = ()
        """The stops, or the release, that were last requested while there was no link."""
        self._presses: set[str] = set()
        self._zeroed = False
        """Whether the network was silent when the last command was sent."""
        self._shown: tuple[DriveInfo | None, bool, DriveInfo] = None, False, IDLE
        """The state that the link reports, whether the network is silent, and the state that results from both."""
        self._reopening: threading.Thread | None = None

    def connect(self) -> DriveNode:
        """Connect to the robot, and send the stops and releases requested before."""
        node = self._connect()
        with self._lock:
            self._node, self._link = node, node.link
            for hold, reason in self._requests:
                node.link.stop(hold, reason)
            for each in self._presses:
                node.link.hold_early(each)
            self._requests = ()
        return node

    def attach(self, world: WorldWatch) -> None:
        """Provide the robot's surroundings, which are watched from now on."""
        self._world = world

    @property
    def world(self) -> WorldInfo:
        """The robot's surroundings; the same object until they change."""
        return self._world.info if self._world else NO_WORLD

    def info(self, world: WorldInfo) -> DriveInfo:
        """The state of the command chain; the same object while nothing changes."""
        is_silent = bool(self._network().silent_s)
        if not is_silent:
            self._zero_again()
        if self._is_unsent:
            unsent = NOT_YET if self._gate.unreached == STARTING else NOT_CONNECTED
            return unsent if self._requests else replace(unsent, own_stops=frozenset())
        known = self._link.info(world) if self._link else IDLE
        if not (is_silent or self._gate.read_only):
            return known
        if self._shown[0] is not known or self._shown[1] != is_silent:
            searching = known.searching or is_silent  # a robot behind a silent link is not absent
            self._shown = known, is_silent, replace(known, searching=searching, refused=self._gate.read_only)
        return self._shown[2]

    @property
    def _is_unsent(self) -> bool:
        """Whether a stop was requested that could not be sent yet."""
        return self._node is None and (self._stops_wait or bool(self._presses))

    @property
    def _stops_wait(self) -> bool:
        return bool(self._requests) and self._requests[0][0]

    def _remember(self, hold: bool, reason: str) -> None:
        """Add a stop to those that wait for a link, or replace all of them by a release.

        Each is sent with its own reason, so that a stop made by the console itself does not replace a person's.
        """
        before = self._requests if hold and self._stops_wait else ()
        self._requests = tuple(dict.fromkeys((*before, (hold, reason))))

    def stop(self, hold: bool = True, reason: str = "ALL STOP") -> None:
        """Lock the robot's emergency stop, or release this console's stop. A stop is accepted in every state."""
        why = self._gate.read_only or (CLOSED if self._gate.unreached == CLOSED else "")
        if not hold and why:
            self._report(f"the robot stays locked: {why}")
            return
        with self._lock:
            if self._node is not None:
                self._node.link.stop(hold, reason)
            else:
                self._remember(hold, reason)
                self._open_again()
        if hold:
            # otherwise repeated messages would drive the robot again once it is released
            self._on_stop()

    def hold_early(self, press: str) -> None:
        """Stop the robot for a key press that has not been handled yet."""
        with self._lock:
            if self._node is not None:
                self._node.link.hold_early(press)
            else:
                self._presses.add(press)
                self._open_again()
        self._on_stop()

    def settle_early(self, press: str, *, keep: bool) -> None:
        """Keep the stop for a key press, or withdraw it and no other."""
        with self._lock:
            self._presses.discard(press)
            if self._node is not None:
                self._node.link.settle_early(press, keep=keep)
            elif keep:
                self._remember(True, "ALL STOP")

    def _open_again(self) -> None:
        """Open a link again for an unsent stop, unless the first link is still being opened."""
        is_busy = self._reopening is not None and self._reopening.is_alive()
        if self._is_unsent and self._gate.unreached != STARTING and not is_busy:
            self._reopening = threading.Thread(target=self._stop_alone, name="bot-console-stop", daemon=True)
            self._reopening.start()

    def _stop_alone(self) -> None:
        """Send the unsent stops, which nothing else can send any more, until the robot confirms them."""
        wait = threading.Event().wait
        while self._is_unsent:
            try:
                node = self.connect()
            except Exception:  # whatever the reason, the status line says that the stop is not sent
                wait(RECONNECT_PAUSE_S)
                continue
            node.follow_alone()
            while node.link.info(NO_WORLD).stopped_here and not node.link.info(NO_WORLD).stop_confirmed:
                wait(CONFIRMATION_POLL_S)
            self.leave()

    def release(self, others: Sequence[str]) -> None:
        """Release this console's stop and those of others."""
        if self._gate.refusal or self._node is None:
            self.stop(False)
        else:
            self._node.link.stop(False, "", others)

    def move(self, linear: float, angular: float, sideways: float = 0.0) -> None:
        """Send a velocity command; while the network is silent, send a single zero instead."""
        if self._node is None or (self._gate.refusal and (linear, angular, sideways) != (0.0, 0.0, 0.0)):
            return
        if not self._network().silent_s:
            self._zero_again()
            self._node.link.drive(linear, angular, sideways)
        elif not self._zeroed:
            # Commands queued while the link is cut arrive late, so the last of them has to be a zero.
            self._zeroed = True
            self._node.link.drive(0.0, 0.0)

    def _zero_again(self) -> None:
        """Repeat the zero after a silence of the network, in which queued messages may have been lost."""
        if self._zeroed:
            self._zeroed = False
            if self._node is not None:
                self._node.link.drive(0.0, 0.0)

    @property
    def steers(self) -> bool:
        """Whether this console has control of the robot; from any thread."""
        return self._node is not None and self._node.link.steers

    def steer(self, hold: bool) -> None:
        """Take control of the robot, or hand it back."""
        if self._node is not None and not (hold and self._gate.refusal):
            self._node.link.steer(hold)

    def choose(self, robot: str) -> None:
        """Drive another robot, and watch its surroundings."""
        if self._node is None or self._gate.unreached:
            return
        self._node.link.choose(robot)

        async def watch() -> None:
            if self._world is not None:
                self._world.choose(robot)

        self._gate.run(watch, lambda why: None, changes=False)

    def pose_at(self, stamp: int) -> Pose | None:
        """The robot's pose at a time; None if it is unknown."""
        return self._world.past.at(stamp) if self._world else None

    def await_held(self, timeout_s: float) -> None:
        """Wait until a stop holds the robot, at most `timeout_s`; returns at once if there is no connection."""
        if self._node is not None:
            self._node.link.await_standing(timeout_s)

    def follow_alone(self) -> None:
        """Keep the connection that stops the robot up to date, after everything else has failed."""
        if self._node is not None:
            self._node.follow_alone()

    def send_last_zero(self) -> None:
        """Send zero velocity, or lock a robot that this console steers, and wait until that has arrived."""
        if self._node is not None:
            self._node.link.close(LAST_ZERO_TIMEOUT_S)

    def leave(self) -> None:
        """Close the link to the robot."""
        with self._lock:
            node, self._node = self._node, None
        if node is not None:
            node.close()
            node.context.try_shutdown()
