"""How long a server keeps the results of its goals."""

from __future__ import annotations

from typing import Any

from action_msgs.msg import GoalStatus, GoalStatusArray
from action_pair import Pair
from rclpy.qos import qos_profile_action_status_default
from rosgraph_msgs.msg import Clock
from systems import system

SIM_TIME = ("-p", "use_sim_time:=true")

PROGRAM = """
import time
import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionClient, ActionServer

def execute(handle):
    time.sleep(3.0)
    handle.succeed()
    return Fibonacci.Result(sequence=[1])

rclpy.init()
node = rclpy.create_node("n")
server = ActionServer(node, Fibonacci, "fib", execute, result_timeout=2.0)
client = ActionClient(node, Fibonacci, "fib")

def outcome(future):
    rclpy.spin_until_future_complete(node, future)
    return future.result()

handle = outcome(client.send_goal_async(Fibonacci.Goal()))
print(outcome(handle.get_result_async()).status)
for wait in (1.5, 1.0):
    until = rclpy.task.Future()
    timer = node.create_timer(wait, lambda: until.set_result(None))
    outcome(until)
    node.destroy_timer(timer)
    print(outcome(handle.get_result_async()).status)
"""


class SimulatedAction(Pair):
    """An action in simulated time."""

    def __init__(self, ros: Any, **server: Any) -> None:
        ros.init(*SIM_TIME)
        super().__init__(ros, **server)
        self._clock = ros.node("driver").create_publisher(Clock, "/clock", 10)
        self.go_to(1)

    def go_to(self, seconds: int) -> None:
        """Set simulated time (s)."""
        message = Clock()
        message.clock.sec = seconds
        self._clock.publish(message)
        self.ros.spin(lambda: self.server_node.get_clock().now().nanoseconds == seconds * 10**9)
        self.ros.settle()


def test_results_expire_by_the_nodes_clock(ros: Any) -> None:
    pair = SimulatedAction(ros, result_timeout=5)
    handle = pair.send()
    seen = []
    for now in (1, 6, 7):
        pair.go_to(now)
        seen.append(pair.result(handle).status)
    assert seen == [GoalStatus.STATUS_SUCCEEDED, GoalStatus.STATUS_SUCCEEDED, GoalStatus.STATUS_UNKNOWN]


def test_each_result_expires_separately(ros: Any) -> None:
    pair = SimulatedAction(ros, result_timeout=5)
    first = pair.send()
    pair.go_to(4)
    second = pair.send()
    pair.go_to(8)
    assert [pair.result(each).status for each in (first, second)] == [
        GoalStatus.STATUS_UNKNOWN,
        GoalStatus.STATUS_SUCCEEDED,
    ]


def test_goal_that_has_not_ended_does_not_expire(ros: Any) -> None:
    kept: list[Any] = []
    pair = SimulatedAction(ros, result_timeout=5, handle_accepted_callback=kept.append)
    handle = pair.send()
    pair.go_to(100)
    kept[0].execute()
    assert pair.result(handle).status == GoalStatus.STATUS_SUCCEEDED


def test_expired_goals_leave_the_status(ros: Any) -> None:
    pair = SimulatedAction(ros, result_timeout=5)
    pair.send()
    pair.go_to(10)
    pair.result(pair.send())
    seen: list[Any] = []
    pair.client_node.create_subscription(
        GoalStatusArray, "/fib/_action/status", seen.append, qos_profile_action_status_default
    )
    ros.spin(lambda: bool(seen))
    assert len(seen[0].status_list) == 1


def test_results_expire_in_system_time_after_the_end_of_the_goal() -> None:
    with system() as running:
        program = running.finish(running.python("-c", PROGRAM))
    assert (program.stdout, program.stderr) == ("4\n4\n0\n", "")
