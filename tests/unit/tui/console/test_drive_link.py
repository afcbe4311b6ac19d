"""Velocity commands of the console, and what it sees of their path to the robot."""

import math

import pytest
from bot_console.tui.console.model import Endpoint, GraphInfo, NodeInfo
from bot_console.tui.console.robot import drive_link
from bot_console.tui.console.robot.drive_link import NO_ARBITER, NO_COMMAND, DriveLink
from bot_console.tui.console.robot.robot_model import Pose, WorldInfo
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from domains import unused_domain
from geometry_msgs.msg import Twist, TwistStamped
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile

LATCHED = DurabilityPolicy.TRANSIENT_LOCAL
TWIST = "geometry_msgs/msg/Twist"


_made: list["Bench"] = []


@pytest.fixture(autouse=True)
def close_benches():
    """Close all benches: a remaining node would keep the `/rosout` publisher of its name from later nodes."""
    yield
    while _made:
        _made.pop().close()


class Bench:
    """A console's link, and a node that takes the robot's place."""

    def __init__(self, *topics: str, arbiter: bool = False) -> None:
        context = self.context = Context()
        _made.append(self)
        context.init(["test"], domain_id=unused_domain())
        self.console, self.robot = Node("console", context=context), Node("robot", context=context)
        self.executor = SingleThreadedExecutor(context=context)
        for each in (self.console, self.robot):
            self.executor.add_node(each)
        self.got: list[tuple[str, float]] = []
        for topic in topics:
            self.robot.create_subscription(Twist, topic, self._listener(topic), 10)
        self.link = DriveLink(self.console)
        reported = (Endpoint("/diagnostics", ("diagnostic_msgs/msg/DiagnosticArray",)),) if arbiter else ()
        listened = tuple(Endpoint(topic, (TWIST,)) for topic in topics)
        self.link.follow(GraphInfo(nodes=(NodeInfo("/robot", subscriptions=listened, publishers=reported),)))

    def _listener(self, topic):
        return lambda message: self.got.append((topic, message.linear.x))

    def close(self):
        for each in (self.console, self.robot):
            each.destroy_node()
        self.context.try_shutdown()

    def settle(self):
        for _ in range(30):
            self.executor.spin_once(timeout_sec=0)


@pytest.fixture
def bench():
    return Bench("/cmd_vel", "/cmd_vel_teleop")


def test_a_person_drives_through_the_arbiter(bench):
    bench.link.drive(0.5, 0.0)
    bench.settle()
    assert bench.got == [("/cmd_vel_teleop", 0.5)]


def test_a_robot_without_arbiter_is_driven_directly():
    bench = Bench("/ns/cmd_vel")
    bench.link.drive(0.5, 0.0)
    bench.settle()
    assert bench.got == [("/ns/cmd_vel", 0.5)]


def test_all_stop_sends_zero_everywhere_and_ignores_commands(bench):
    bench.link.stop(True, "ALL STOP")
    bench.link.drive(0.5, 0.0)
    bench.settle()
    assert sorted(set(bench.got)) == [("/cmd_vel", 0.0), ("/cmd_vel_teleop", 0.0)]
    assert bench.link.info(WorldInfo()).stopped


def test_all_stop_answers_another_publishers_command_at_once(bench):
    other = bench.robot.create_publisher(Twist, "/cmd_vel", 10)
    bench.link.stop(True, "ALL STOP")
    bench.settle()
    command = Twist()
    command.linear.x = 1.0
    other.publish(command)
    bench.settle()
    assert [value for topic, value in bench.got if topic == "/cmd_vel"][-2:] == [1.0, 0.0]


def test_a_holonomic_base_is_driven_sideways_and_held_against_sideways_commands(bench):
    sideways: list[float] = []
    bench.robot.create_subscription(Twist, "/cmd_vel_teleop", lambda each: sideways.append(each.linear.y), 10)
    bench.link.drive(0.5, 0.0, -0.25)
    bench.settle()
    assert sideways == [-0.25]
    other = bench.robot.create_publisher(Twist, "/cmd_vel", 10)
    bench.link.stop(True, "ALL STOP")
    bench.settle()
    bench.got.clear()
    command = Twist()
    command.linear.y = 1.0
    other.publish(command)
    bench.settle()
    assert bench.got == [("/cmd_vel", 0.0)] * 2, "the command, and at once our zero"
    with pytest.raises(ValueError, match="finite"):
        bench.link.drive(0.0, 0.0, math.nan)


def test_a_released_robot_can_be_driven_again(bench):
    bench.link.stop(True, "ALL STOP")
    bench.link.stop(False, "")
    bench.link.drive(0.5, 0.0)
    bench.settle()
    assert ("/cmd_vel_teleop", 0.5) in bench.got


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_a_velocity_that_is_not_finite_is_refused(bench, value):
    with pytest.raises(ValueError, match="finite"):
        bench.link.drive(value, 0.0)
    bench.settle()
    assert bench.got == []


def test_the_arbiters_reason_is_shown():
    bench = Bench("/cmd_vel", arbiter=True)
    publisher = bench.robot.create_publisher(DiagnosticArray, "/diagnostics", 10)
    values = {"limited_by": "warning_distance", "final.linear": "0.2", "final.angular": "0"}
    values |= {"asked.linear": "0.8", "asked.angular": "0"}
    pairs = [KeyValue(key=key, value=value) for key, value in values.items()]
    publisher.publish(DiagnosticArray(status=[DiagnosticStatus(values=pairs)]))
    bench.settle()
    info = bench.link.info(WorldInfo(pose=Pose(), speed=0.1))
    assert (info.limited_by, info.asked, info.limited) == ("warning_distance", (0.8, 0.0), (0.2, 0.0))


def test_silence_of_the_robot_is_reported(bench, monkeypatch):
    other = bench.robot.create_publisher(Twist, "/cmd_vel", 10)
    other.publish(Twist())
    bench.settle()
    assert bench.link.info(WorldInfo()).final == (0.0, 0.0)
    monkeypatch.setattr(drive_link, "COMMAND_LIFETIME_S", -1.0)
    info = bench.link.info(WorldInfo())
    assert (info.final, info.limited_by) == (None, NO_COMMAND)


def _listening(*topics):
    return GraphInfo(nodes=(NodeInfo("/robot", subscriptions=tuple(Endpoint(each, (TWIST,)) for each in topics)),))


def test_a_robot_whose_arbiter_has_left_is_not_driven_directly():
    bench = Bench("/cmd_vel", "/cmd_vel_teleop")
    bench.link.follow(_listening("/cmd_vel"))
    bench.link.drive(1.0, 0.0)
    bench.settle()
    assert bench.got == [("/cmd_vel", 0.0)], "it stops at once"
    bench.got.clear()
    info = bench.link.info(WorldInfo())
    assert (info.topic, info.limited_by) == ("", NO_ARBITER)
    bench.link.stop(False, "")
    bench.settle()
    assert bench.got == [("/cmd_vel", 0.0)], "it can still be stopped"
    bench.link.follow(_listening("/cmd_vel", "/cmd_vel_teleop"))
    assert (bench.link.topic, bench.link.info(WorldInfo()).limited_by) == ("/cmd_vel_teleop", "")


def test_zeros_continue_until_release_if_the_lock_dies_before_acknowledging():
    bench = Bench("/cmd_vel")
    lock = Endpoint("/emergency_stop/arbiter", ("diagnostic_msgs/msg/DiagnosticStatus",))
    listened = (Endpoint("/cmd_vel_teleop", (TWIST,)),)
    arbiter = NodeInfo("/arbiter", publishers=(lock,), subscriptions=listened)
    bench.link.follow(GraphInfo(nodes=(*_listening("/cmd_vel").nodes, arbiter)))
    bench.link.stop(True, "ALL STOP")
    bench.link._repeat()
    bench.link.follow(_listening("/cmd_vel"))  # the arbiter was killed
    bench.settle()
    bench.got.clear()
    bench.link._repeat()
    bench.settle()
    assert bench.got and set(bench.got) == {("/cmd_vel", 0.0)}
    bench.link.stop(False, "")
    bench.settle()
    bench.got.clear()
    bench.link._repeat()
    bench.settle()
    assert bench.got == []


def test_zeros_continue_until_the_lock_acknowledges_the_stop():
    bench = Bench("/cmd_vel", "/cmd_vel_teleop")
    topic, kind = "/emergency_stop/arbiter", "diagnostic_msgs/msg/DiagnosticStatus"
    message_of = bench.robot.create_publisher(DiagnosticStatus, topic, QoSProfile(depth=1, durability=LATCHED))
    arbiter = NodeInfo("/arbiter", publishers=(Endpoint(topic, (kind,)),))
    bench.link.follow(GraphInfo(nodes=(*_listening("/cmd_vel", "/cmd_vel_teleop").nodes, arbiter)))
    bench.link.stop(True, "ALL STOP")
    for _ in range(3):  # the lock hangs
        bench.settle()
        bench.got.clear()
        bench.link._repeat()
        bench.settle()
        assert sorted(bench.got) == [("/cmd_vel", 0.0), ("/cmd_vel_teleop", 0.0)]
    message_of.publish(DiagnosticStatus(values=[KeyValue(key="locked", value="true")]))
    bench.settle()
    bench.got.clear()
    bench.link._repeat()
    bench.settle()
    assert bench.got == [] and bench.link.info(WorldInfo()).stop_confirmed


def test_a_new_robot_without_arbiter_is_driven_directly():
    bench = Bench("/cmd_vel", "/cmd_vel_teleop")
    bench.link.follow(_listening())
    bench.link.follow(_listening("/cmd_vel"))
    bench.link.drive(1.0, 0.0)
    bench.settle()
    assert bench.got == [("/cmd_vel", 1.0)]


STAMPED = "geometry_msgs/msg/TwistStamped"


def _robots(*ends: tuple[str, str], clock: bool = False) -> GraphInfo:
    listened = tuple(Endpoint(topic, (kind,)) for topic, kind in ends)
    topics = (Endpoint("/clock", ("rosgraph_msgs/msg/Clock",)),) if clock else ()
    return GraphInfo(nodes=(NodeInfo("/robot", subscriptions=listened),), topics=topics)


@pytest.mark.parametrize("simulated", [False, True])
def test_stamped_commands_are_sent_on_demand_without_our_time_in_simulated_time(simulated):
    bench, got = Bench(), []
    bench.robot.create_subscription(TwistStamped, "/base/cmd_vel", got.append, 10)
    bench.link.follow(_robots(("/base/cmd_vel", STAMPED), clock=simulated))
    bench.link.drive(0.5, -0.25)
    bench.settle()
    (message,) = got
    assert (message.twist.linear.x, message.twist.angular.z) == (0.5, -0.25)
    assert (message.header.stamp.sec == 0) is simulated
    bench.settle()
    assert bench.link.info(WorldInfo()).final == (0.5, -0.25)


def test_one_of_several_robots_is_driven_and_all_are_stopped():
    bench = Bench("/a/cmd_vel", "/bb/cmd_vel", "/elsewhere/velocity")
    bench.link.follow(_robots(("/bb/cmd_vel", TWIST), ("/a/cmd_vel", TWIST), ("/elsewhere/velocity", TWIST)))
    info = bench.link.info(WorldInfo())
    assert (info.robot, info.robots) == ("/a", ("/a", "/bb", "/elsewhere/velocity"))
    bench.link.drive(0.5, 0.0)
    bench.link.choose("/bb")
    bench.link.drive(0.25, 0.0)
    bench.settle()
    assert sorted(bench.got) == [("/a/cmd_vel", 0.0), ("/a/cmd_vel", 0.5), ("/bb/cmd_vel", 0.25)]
    bench.got.clear()
    bench.link.stop(True, "ALL STOP")
    bench.settle()
    assert set(bench.got) == {("/a/cmd_vel", 0.0), ("/bb/cmd_vel", 0.0)}


def test_a_topic_with_another_name_is_driven_only_when_chosen():
    bench = Bench("/elsewhere/velocity")
    bench.link.follow(_robots(("/elsewhere/velocity", TWIST)))
    bench.link.drive(0.5, 0.0)
    assert bench.link.info(WorldInfo()).topic == ""
    bench.link.choose("/elsewhere/velocity")
    bench.link.drive(0.5, 0.0)
    bench.link.stop(True, "ALL STOP")
    bench.settle()
    assert bench.got[0] == ("/elsewhere/velocity", 0.5)
    assert set(bench.got[1:]) == {("/elsewhere/velocity", 0.0)}


def test_a_robot_that_was_only_watched_receives_nothing_when_the_console_leaves():
    bench = Bench("/cmd_vel")
    bench.link.close()
    bench.settle()
    assert bench.got == []
    bench.link.drive(0.5, 0.0)
    bench.link.close()
    bench.settle()
    assert bench.got == [("/cmd_vel", 0.5), ("/cmd_vel", 0.0)]


class Waits:
    """The times (s) for which a link waits without acknowledgement."""

    def __init__(self, monkeypatch):
        self.waited = []
        monkeypatch.setattr(drive_link.threading, "Event", lambda: self)

    def wait(self, seconds):
        self.waited.append(seconds)


def test_closing_waits_for_an_unacknowledged_zero_if_there_is_a_subscription(monkeypatch):
    bench, waits = Bench("/cmd_vel"), Waits(monkeypatch)
    bench.link.close(7.0)
    assert waits.waited == [], "it was only watched"
    bench.link.drive(0.5, 0.0)
    bench.link.close(7.0)
    assert waits.waited == [7.0]


def test_closing_does_not_wait_for_a_robot_that_has_left(monkeypatch):
    bench, waits = Bench("/cmd_vel"), Waits(monkeypatch)
    bench.link.stop(True, "bot-console was quit")
    bench.robot.destroy_node()
    bench.link.await_standing(7.0)
    assert waits.waited == []
