"""Topics, services and actions of real nodes: topics measured, received and published, services called, goals sent."""

from __future__ import annotations

import os
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest
import rclpy
from bot_console.tui.console.model import GraphInfo
from bot_console.tui.console.robot import robot_drive
from bot_console.tui.console.ros_console import RosConsole
from bot_console.tui.console.topics.offered_topics import offered_qos
from bot_console.tui.console.topics.port import Payload, RequestedQos
from domains import unused_domain
from example_interfaces.action import Fibonacci
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.action import ActionServer, CancelResponse
from rclpy.context import Context
from rclpy.executors import MultiThreadedExecutor
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rigs import TIMEOUT_S, until
from std_srvs.srv import SetBool

TWIST, SET_BOOL, FIBONACCI = "geometry_msgs/msg/Twist", "std_srvs/srv/SetBool", "example_interfaces/action/Fibonacci"


class Robot:
    """Publishes odometry at 50 Hz, best effort; offers a velocity topic, a service, and an action that waits to be
    ended."""

    def __init__(self, domain: int) -> None:
        self.context = Context()
        rclpy.init(args=[], context=self.context, domain_id=domain)
        self.node = rclpy.create_node("robot", context=self.context)
        self.velocities: list[float] = []
        self.may_end = threading.Event()
        sensor = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)
        self.odometry = self.node.create_publisher(Odometry, "odom", sensor)
        self.node.create_timer(0.02, self._report)
        self.node.create_subscription(Twist, "cmd_vel", lambda each: self.velocities.append(each.linear.x), 50)
        self.node.create_service(SetBool, "enable", self._enable)
        ActionServer(self.node, Fibonacci, "count", self._count, cancel_callback=lambda goal: CancelResponse.ACCEPT)
        self.executor = MultiThreadedExecutor(3, context=self.context)
        self.executor.add_node(self.node)
        self.thread = threading.Thread(target=self.executor.spin, daemon=True)
        self.thread.start()

    def _report(self) -> None:
        message = Odometry()
        message.header.stamp = self.node.get_clock().now().to_msg()
        message.pose.pose.position.x = 4.25
        self.odometry.publish(message)

    def _enable(self, request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        response.success, response.message = request.data, "it is on" if request.data else "it is off"
        return response

    def _count(self, goal):
        goal.publish_feedback(Fibonacci.Feedback(sequence=[0, 1]))
        while not self.may_end.wait(0.005):
            if goal.is_cancel_requested:
                goal.canceled()
                return Fibonacci.Result()
        goal.succeed()
        return Fibonacci.Result(sequence=[0, 1, 1])

    def close(self) -> None:
        self.may_end.set()
        self.executor.shutdown()
        self.context.shutdown()


@pytest.fixture
def robot(monkeypatch: pytest.MonkeyPatch) -> Iterator[Robot]:
    number = unused_domain()
    monkeypatch.setenv("ROS_DOMAIN_ID", str(number))
    monkeypatch.setattr(robot_drive, "LAST_ZERO_TIMEOUT_S", 0.0)
    made = Robot(number)
    yield made
    made.close()


@pytest.fixture
def console(robot: Robot) -> Iterator[RosConsole]:
    made = RosConsole()
    made.start()
    until(lambda: any(each.name == "/odom" for each in made.snapshot().graph.topics), "the topic")
    yield made
    made.close()


def test_a_topic_is_measured_with_the_qos_offered_and_released(console: RosConsole) -> None:
    graph: GraphInfo = console.snapshot().graph
    assert not offered_qos(graph, "/odom").reliable, "best effort is offered, so best effort is requested"
    traffic = console.topics
    traffic.measure(["/odom"])
    found = until(lambda: next((e for e in traffic.measured().values() if e.count > 20 and e.rate), None), "messages")
    assert 10 < found.rate < 100 and found.bandwidth == pytest.approx(found.rate * 724, rel=0.3)
    assert found.latency is not None and 0 <= found.latency < 1
    traffic.measure([])
    until(lambda: not traffic.measured(), "nothing measured")


def test_the_newest_message_is_shown_as_lines(console: RosConsole) -> None:
    console.topics.listen("/odom")
    heard = until(lambda: console.topics.heard() if console.topics.heard().count else None, "a message")
    assert {each.path: each.text for each in heard.fields}["pose.pose.position.x"] == "4.25"
    console.topics.listen("/nowhere")
    until(lambda: "no topic /nowhere" in console.topics.heard().problem, "the problem")


def test_a_topic_is_subscribed_to_with_the_requested_qos(console: RosConsole, robot: Robot) -> None:
    def reliabilities() -> set[ReliabilityPolicy]:
        return {each.qos_profile.reliability for each in robot.node.get_subscriptions_info_by_topic("/odom")}

    console.topics.listen("/odom", RequestedQos("best_effort", "volatile", "keep_last", 3))
    until(lambda: console.topics.heard().count, "a message")
    assert ReliabilityPolicy.RELIABLE not in reliabilities()
    console.topics.listen("/odom", RequestedQos("reliable", depth=7))
    until(lambda: ReliabilityPolicy.RELIABLE in reliabilities(), "a reliable subscription")
    assert console.topics.heard().count == 0, "nothing arrives from a best-effort publisher"


def test_a_message_is_published_once_or_at_a_rate_until_stopped(console: RosConsole, robot: Robot) -> None:
    traffic = console.topics
    assert traffic.publish("/cmd_vel", TWIST, {"linear.x": "0.5"}).ok
    until(lambda: robot.velocities == [0.5], "the one message")
    assert not traffic.publish("/cmd_vel", TWIST, {"linear.x": "fast"}).ok
    assert not traffic.publish("/cmd_vel", TWIST, {}, 1e6).ok
    assert traffic.publish("/cmd_vel", TWIST, {"linear.x": "0.7"}, 100.0).ok
    until(lambda: robot.velocities.count(0.7) > 5, "messages at a rate")
    assert traffic.repeated()["/cmd_vel"].rate == 100.0
    console.drive.stop()
    until(lambda: not traffic.repeated(), "an end of that")
    assert [dict(each) for each in traffic.earlier("/cmd_vel")] == [{"linear.x": "0.5"}, {"linear.x": "0.7"}]


def test_a_service_is_called_and_its_response_shown(console: RosConsole) -> None:
    reply = console.topics.call("/enable", SET_BOOL, {"data": "true"}).result(TIMEOUT_S)
    assert reply.ok and reply.seconds > 0
    assert [(each.name, each.text) for each in reply.fields] == [("success", "true"), ("message", "it is on")]
    wrong = console.topics.call("/enable", SET_BOOL, {"data": "perhaps"}).result(TIMEOUT_S)
    assert not wrong.ok and "neither true nor false" in wrong.text
    gone = console.topics.call("/nowhere", SET_BOOL, {}).result(TIMEOUT_S)
    assert not gone.ok and "no service /nowhere" in gone.text


def test_a_goal_gives_feedback_and_a_result(console: RosConsole, robot: Robot) -> None:
    traffic = console.topics
    assert traffic.send_goal("/count", FIBONACCI, {"order": "3"}).ok
    until(lambda: traffic.goals()["/count"].feedback_count if "/count" in traffic.goals() else 0, "feedback")
    assert traffic.goals()["/count"].feedback[0].text == "[0, 1]"
    robot.may_end.set()
    until(lambda: not traffic.goals()["/count"].active, "the end")
    goal = traffic.goals()["/count"]
    assert (goal.status, goal.result[0].text) == ("succeeded", "[0, 1, 1]")
    assert not traffic.cancel("/count").ok


def test_a_goal_can_be_cancelled(console: RosConsole) -> None:
    traffic = console.topics
    traffic.send_goal("/count", FIBONACCI, {})
    until(lambda: traffic.goals().get("/count") and traffic.goals()["/count"].status == "executing", "the goal to run")
    assert traffic.cancel("/count").ok
    until(lambda: traffic.goals()["/count"].status == "canceled", "the cancellation")


def test_the_command_line_sends_the_same(console: RosConsole) -> None:
    line = console.topics.line(Payload.MESSAGE, "/cmd_vel", TWIST, {"linear.x": "0.5"}, 10)
    assert line == "ros2 topic pub --rate 10 /cmd_vel geometry_msgs/msg/Twist '{linear: {x: 0.5}}'"
    assert console.topics.line(Payload.REQUEST, "/enable", SET_BOOL, {"data": "yes"}).endswith("'{data: true}'")


def test_before_the_console_is_connected_everything_is_refused_with_a_reason() -> None:
    idle = RosConsole().topics
    assert "still connecting" in idle.heard().problem and not idle.publish("/t", TWIST, {}).ok
    assert not idle.call("/s", SET_BOOL, {}).result(0).ok and not idle.measured() and not idle.cancel("/a").ok


@pytest.mark.skipif(os.name == "nt", reason="needs named pipes")
def test_pipe_in_the_place_of_expected_rates_is_refused(console: RosConsole, tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "rates.yaml")
    answer = console.topics.expect(str(tmp_path / "rates.yaml"))
    assert not answer.ok and answer.text.endswith("it is not a regular file")
