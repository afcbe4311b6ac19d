"""Two robots on one graph: values, map, limits and verdicts belong to the driven one; a stop applies to both."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from bot_console.tui.console.launch.external_programs import ExternalPrograms
from bot_console.tui.console.model import Capabilities, Endpoint, GraphInfo, LaunchInfo, LinkInfo, NodeInfo
from bot_console.tui.console.node import ConsoleNode
from bot_console.tui.console.node_ports import NodePorts
from bot_console.tui.console.robot.drive_link import COMMAND_LIFETIME_S, VERDICT_LIFETIME_S, DriveLink
from bot_console.tui.console.robot.drive_node import DriveNode
from bot_console.tui.console.robot.fleet import Fleet, driven_robot
from bot_console.tui.console.robot.pose_and_trail import MAP, ODOMETRY, WorldWatch
from bot_console.tui.console.robot.robot_model import DriveInfo
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from domains import unused_domain
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

TWIST, DIAGNOSTICS = "geometry_msgs/msg/Twist", "diagnostic_msgs/msg/DiagnosticArray"


def node(name: str, listens: str = "", publishes: str = "") -> NodeInfo:
    """A node given by `topic=type` words; the default type is Twist."""

    def ends(text: str) -> tuple[Endpoint, ...]:
        words = (each.partition("=") for each in text.split())
        return tuple(Endpoint(topic, (kind or TWIST,)) for topic, _, kind in words)

    return NodeInfo(name, publishers=ends(publishes), subscriptions=ends(listens))


def own_topic(graph: GraphInfo, robot: str, kind: str, *, shared: bool = False) -> set[str]:
    fleet = Fleet(graph)
    return fleet.scope(driven_robot(fleet.robots, robot)).own(fleet.published(kind), shared=shared)


BASE = node("/base", "/cmd_vel", f"/odom={ODOMETRY} /map={MAP}")


@pytest.mark.parametrize(
    ("nodes", "robot", "expected"),
    [
        pytest.param((BASE, node("/robot2/base", "/robot2/cmd_vel", f"/robot2/odom={ODOMETRY}")), "/robot2",
                     "/robot2/odom", id="in its namespace"),
        pytest.param((BASE, node("/robot2/base", "/robot2/cmd_vel", f"/robot2/odom={ODOMETRY}")), "/",
                     "/odom", id="the one without a namespace"),
        pytest.param((BASE, node("/robot2/base", "/robot2/cmd_vel")), "/robot2", "", id="none is not another's"),
        pytest.param((BASE, node("/base2", "/robot2/cmd_vel", f"/odom2={ODOMETRY}")), "/robot2",
                     "/odom2", id="published by the node that obeys it"),
        pytest.param((node("/base2", "/robot2/cmd_vel", f"/odom2={ODOMETRY}"), node("/base", "/cmd_vel"),
                      node("/ekf", "", f"/odometry/filtered={ODOMETRY}")), "/", "/odometry/filtered",
                     id="published by the node that obeys another"),
        pytest.param((node("/stamper", "/cmd_vel", "/base/cmd_vel"), node("/base", "/base/cmd_vel",
                      f"/base/odom={ODOMETRY}")), "/", "/base/odom", id="behind a multiplexer"),
        pytest.param((node("/stamper", "/cmd_vel", "/base/cmd_vel"), node("/base", "/base/cmd_vel"),
                      node("/ekf", "", f"/odom={ODOMETRY}")), "/base", "/odom", id="before a multiplexer"),
        pytest.param((node("/bridge", "/a/cmd_vel /b/cmd_vel", f"/a/odom={ODOMETRY} /b/odom={ODOMETRY}"),), "/b",
                     "/b/odom", id="one bridge for both"),
        pytest.param((node("/one", "/velocity_one", f"/where_one={ODOMETRY}"),
                      node("/two", "/velocity_two", f"/where_two={ODOMETRY}")), "/velocity_two", "/where_two",
                     id="two names in one namespace"),
        pytest.param((node("/a/base", "/a/cmd_vel"), node("/a/b/base", "/a/b/cmd_vel", f"/a/b/odom={ODOMETRY}")), "/a",
                     "", id="a namespace within a namespace"),
        pytest.param((node("/robot1/base", "/robot1/cmd_vel"), node("/robot10/base", "/robot10/cmd_vel",
                      f"/robot10/odom={ODOMETRY}")), "/robot1", "", id="a namespace that begins with the other"),
        pytest.param((node("/one", "/cmd_vel"), node("/mocap", "", f"/mocap/pose={ODOMETRY}")), "/", "/mocap/pose",
                     id="one robot alone"),
    ],
)  # fmt: skip
def test_odometry_is_attributed_to_its_robot(nodes: tuple[NodeInfo, ...], robot: str, expected: str) -> None:
    assert own_topic(GraphInfo(nodes=nodes), robot, ODOMETRY) == ({expected} if expected else set())


def test_a_map_server_serves_several_robots_but_a_robots_map_only_itself() -> None:
    robot1 = node("/base", "/cmd_vel", f"/odom={ODOMETRY}")
    robot2 = node("/robot2/base", "/robot2/cmd_vel")
    server = node("/map_server", "", f"/map={MAP}")
    assert own_topic(GraphInfo(nodes=(robot1, robot2, server)), "/robot2", MAP, shared=True) == {"/map"}
    assert own_topic(GraphInfo(nodes=(BASE, robot2)), "/robot2", MAP, shared=True) == set()


class Robots:
    """Two robots, the second in a namespace, each with odometry and verdicts; and a console's view of them."""

    def __init__(self) -> None:
        self.context = Context()
        self.context.init([], domain_id=unused_domain())
        self.executor = SingleThreadedExecutor(context=self.context)
        self.nodes = [Node(name, context=self.context) for name in ("console", "robots")]
        console, robots = self.nodes
        for each in self.nodes:
            self.executor.add_node(each)
        self.clock = 100.0
        self.world = WorldWatch(console, lambda: self.clock)
        self.drive = DriveLink(console, lambda: self.clock)
        self.stopped: dict[str, list[float]] = {"": [], "/robot2": []}
        self.odometry = {space: robots.create_publisher(Odometry, f"{space}/odom", 10) for space in self.stopped}
        self.asked = {space: robots.create_publisher(Twist, f"{space}/cmd_vel_nav", 10) for space in self.stopped}
        kinds = {space: robots.create_publisher(DiagnosticArray, f"{space}/diagnostics", 10) for space in self.stopped}
        self.verdicts = kinds
        for space, heard in self.stopped.items():
            robots.create_subscription(
                Twist, f"{space}/cmd_vel", lambda message, heard=heard: heard.append(message.linear.x), 10
            )
        self.follow("", "/robot2")

    def follow(self, *spaces: str) -> None:
        """Set the robots in the graph."""
        found = tuple(
            node(
                f"{space}/base",
                f"{space}/cmd_vel",
                f"{space}/odom={ODOMETRY} {space}/diagnostics={DIAGNOSTICS} {space}/cmd_vel_nav",
            )
            for space in spaces
        )
        self.world.follow(GraphInfo(nodes=found))
        self.drive.follow(GraphInfo(nodes=found))
        self.settle()

    def choose(self, robot: str) -> None:
        self.drive.choose(robot)
        self.world.choose(robot)
        self.settle()

    def settle(self) -> None:
        for _ in range(30):
            self.executor.spin_once(timeout_sec=0)

    def show_text(self, space: str, speed: float, limited_by: str) -> None:
        message = Odometry()
        message.twist.twist.linear.x = speed
        self.odometry[space].publish(message)
        values = {"limited_by": limited_by, "asked.linear": str(speed), "asked.angular": "0"}
        values |= {"final.linear": str(speed), "final.angular": "0"}
        pairs = [KeyValue(key=key, value=value) for key, value in values.items()]
        self.verdicts[space].publish(DiagnosticArray(status=[DiagnosticStatus(values=pairs)]))
        self.settle()

    @property
    def info(self) -> DriveInfo:
        return self.drive.info(self.world.info)


@pytest.fixture
def robots() -> Iterator[Robots]:
    made = Robots()
    yield made
    for each in made.nodes:
        each.destroy_node()
    made.context.try_shutdown()


def test_values_and_verdicts_follow_the_driven_robot(robots: Robots) -> None:
    def both_say() -> None:
        robots.show_text("", 0.25, "warning_distance")
        robots.show_text("/robot2", 0.75, "no fresh scan")

    both_say()
    assert (robots.info.robot, robots.info.actual, robots.info.limited_by) == ("/", (0.25, 0.0), "warning_distance")
    robots.choose("/robot2")
    assert (robots.info.robot, robots.info.actual, robots.info.asked) == ("/robot2", None, None), "nothing received yet"
    assert robots.world.info.pose is None and robots.world.info.trail == ()
    both_say()
    assert (robots.info.actual, robots.info.asked, robots.info.limited_by) == (
        (0.75, 0.0), (0.75, 0.0), "no fresh scan",
    )  # fmt: skip
    assert robots.info.others == {"/"}
    assert (robots.world.info.robot, robots.world.info.robots) == ("/robot2", ("/", "/robot2"))


def test_values_of_the_previous_robot_are_not_shown_after_a_change(robots: Robots) -> None:
    robots.show_text("", 0.25, "")
    robots.drive.choose("/robot2")
    assert (robots.info.robot, robots.info.actual, robots.info.silent_s) == ("/robot2", None, 0)


def test_a_robot_that_leaves_is_silent_and_its_values_are_not_given_to_the_next(robots: Robots) -> None:
    robots.follow("/robot2")
    robots.show_text("/robot2", 0.75, "")
    robots.follow()
    robots.clock += 5.0
    assert robots.world.info.silent_s == 5
    robots.follow("")
    assert robots.info.actual is None and robots.world.info.silent_s == 0


def test_a_stop_reaches_every_robot_whichever_is_driven(robots: Robots) -> None:
    robots.choose("/robot2")
    robots.drive.stop(True, "ALL STOP")
    robots.settle()
    assert all(heard and set(heard) == {0.0} for heard in robots.stopped.values())


def test_a_verdict_expires_when_its_arbiter_is_silent(robots: Robots) -> None:
    robots.show_text("", 0.4, "emergency_stop_distance")
    robots.clock += VERDICT_LIFETIME_S
    assert (robots.info.asked, robots.info.limited_by) == ((0.4, 0.0), "emergency_stop_distance")
    robots.clock += 0.1
    assert (robots.info.asked, robots.info.limited, robots.info.limited_by) == (None, None, "")


def test_a_requested_velocity_expires_like_a_command(robots: Robots) -> None:
    command = Twist()
    command.linear.x = 0.4
    robots.asked[""].publish(command)
    robots.settle()
    assert robots.info.asked == (0.4, 0.0)
    robots.clock += COMMAND_LIFETIME_S + 0.1
    assert robots.info.asked is None


def test_keys_meant_for_a_robot_that_has_left_do_not_drive_the_next_one(robots: Robots) -> None:
    robots.drive.steer(True)
    robots.drive.drive(0.5, 0.0)
    robots.follow("/robot2")
    robots.drive.drive(0.5, 0.0)
    robots.settle()
    assert robots.info.robot == "/robot2" and 0.5 not in robots.stopped["/robot2"]
    robots.drive.steer(False)
    robots.drive.steer(True)
    robots.drive.drive(0.5, 0.0)
    robots.settle()
    assert robots.stopped["/robot2"][-1] == 0.5


def test_choosing_a_robot_changes_control_and_view_together() -> None:
    context = Context()
    context.init([], domain_id=unused_domain())
    ports = NodePorts(
        lambda: DriveNode(context, lambda error: None), Capabilities(), launch_info=LaunchInfo, link=LinkInfo,
        buffer=None, types=None, generic=None, processes=dict,
        external_programs=ExternalPrograms(),
    )  # fmt: skip
    robot = ports.drive.connect()
    console = ConsoleNode(robot, ports)
    ports.gate.open(console.executor.create_task)
    try:
        spaces = ("", "/robot2")
        graph = GraphInfo(nodes=tuple(node(f"{s}/base", f"{s}/cmd_vel", f"{s}/odom={ODOMETRY}") for s in spaces))
        console._world.follow(graph)
        robot.link.follow(graph)
        ports.drive.choose("/robot2")
        console.executor.spin_once(timeout_sec=0)
        world = ports.drive.world
        assert (world.robot, ports.drive.info(world).robot) == ("/robot2", "/robot2")
    finally:
        console.close()
        ports.drive.leave()
