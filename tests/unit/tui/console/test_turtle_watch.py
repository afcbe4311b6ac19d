"""What the console knows about turtles."""

from __future__ import annotations

import sys
from collections.abc import Iterator

import pytest
import rclpy
from bot_console.tui.console.graph.watch import GraphWatch
from bot_console.tui.console.model import Endpoint, GraphInfo, NodeInfo
from bot_console.tui.console.robot.pose_and_trail import WorldWatch
from bot_console_demos.turtlesim.turtlesim_node import TurtleSim
from geometry_msgs.msg import Twist
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from turtlesim.msg import Pose


class TurtleRig:
    """A console's world watch, spun by hand."""

    def __init__(self) -> None:
        self.node = rclpy.create_node("_watch")
        self.world = WorldWatch(self.node)
        self.executor = SingleThreadedExecutor()
        self.executor.add_node(self.node)
        self.graph = GraphWatch(self.node, self.world.follow)

    def spin_until(self, done: object) -> None:
        """Spin until a condition holds; if that never happens, the test's timeout ends it."""
        while not done():  # type: ignore[operator]
            self.executor.spin_once(timeout_sec=0.1)
            self.graph.poll()


@pytest.fixture
def turtle_rig() -> Iterator[TurtleRig]:
    rclpy.init()
    yield TurtleRig()
    rclpy.shutdown()


def test_turtles_and_their_drawings_are_shown(turtle_rig: TurtleRig) -> None:
    sim = TurtleSim()
    turtle_rig.executor.add_node(sim)
    world = turtle_rig.world
    turtle_rig.spin_until(lambda: world.info.fields and world.info.fields[0].drawing and world.info.fields[0].turtles)
    (field,) = world.info.fields
    assert (field.node, [each.name for each in field.turtles]) == ("/turtlesim", ["turtle1"])
    assert set(field.drawing.pixels[3::4]) == {0}
    driver = turtle_rig.node.create_publisher(Twist, "/turtle1/cmd_vel", 1)
    driver.publish(Twist())
    twist = Twist()
    twist.linear.x = 2.0
    driver.publish(twist)
    turtle_rig.spin_until(lambda: 255 in world.info.fields[0].drawing.pixels[3::4])
    assert world.info.fields[0].turtles[0].pose.x > 5.6
    sim.destroy_node()
    turtle_rig.spin_until(lambda: not world.info.fields)


def test_trails_are_shown_for_a_turtlesim_that_publishes_only_poses(turtle_rig: TurtleRig) -> None:
    other = Node("sim", namespace="/lab")
    poses = other.create_publisher(Pose, "turtle9/pose", 1)
    turtle_rig.graph.poll()
    for x in (1.0, 1.05, 2.0):
        poses.publish(Pose(x=x, y=3.0, theta=0.5, linear_velocity=1.0))
        before = turtle_rig.world.info
        turtle_rig.spin_until(lambda before=before: turtle_rig.world.info is not before)
    (field,) = turtle_rig.world.info.fields
    assert (field.node, field.drawing) == ("/lab/sim", None)
    assert (field.turtles[0].name, field.turtles[0].trail) == ("turtle9", ((1.0, 3.0), (2.0, 3.0)))
    same = turtle_rig.world.info
    poses.publish(Pose(x=2.0, y=3.0, theta=0.5, linear_velocity=1.0))
    turtle_rig.executor.spin_once(timeout_sec=1.0)
    assert turtle_rig.world.info is same


def test_turtles_whose_messages_are_not_installed_are_left_out(
    turtle_rig: TurtleRig, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "turtlesim.msg", None)
    pose = Endpoint("/turtle1/pose", ("turtlesim/msg/Pose",))
    turtle_rig.world.follow(GraphInfo((NodeInfo("/turtlesim", publishers=(pose,)),)))
    (field,) = turtle_rig.world.info.fields
    assert field.turtles == ()
