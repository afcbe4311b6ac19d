"""Action servers and clients understand any peer that uses their services and topics."""

from __future__ import annotations

from typing import Any

from action_msgs.msg import GoalInfo, GoalStatus
from action_msgs.srv import CancelGoal
from example_interfaces.action import Fibonacci
from rclpy.action import ActionClient, ActionServer, CancelResponse
from rclpy.qos import qos_profile_action_status_default
from unique_identifier_msgs.msg import UUID

Impl = Fibonacci.Impl
NUMBER = UUID(uuid=list(range(1, 17)))


class PlainServer:
    """The services and topics of an action server, with constant answers."""

    def __init__(self, node: Any) -> None:
        node.create_service(Impl.SendGoalService, "/fib/_action/send_goal", self.accept)
        node.create_service(Impl.CancelGoalService, "/fib/_action/cancel_goal", self.cancel)
        node.create_service(Impl.GetResultService, "/fib/_action/get_result", self.result)
        self.feedback = node.create_publisher(Impl.FeedbackMessage, "/fib/_action/feedback", 10)
        node.create_publisher(Impl.GoalStatusMessage, "/fib/_action/status", qos_profile_action_status_default)

    def accept(self, request: Any, response: Any) -> Any:
        self.feedback.publish(
            Impl.FeedbackMessage(goal_id=request.goal_id, feedback=Fibonacci.Feedback(sequence=[request.goal.order]))
        )
        response.accepted = True
        return response

    def cancel(self, request: Any, response: Any) -> Any:
        response.goals_canceling.append(request.goal_info)
        return response

    def result(self, request: Any, response: Any) -> Any:
        response.status = GoalStatus.STATUS_SUCCEEDED
        response.result.sequence = [8]
        return response


def test_client_works_with_a_plain_server(ros: Any) -> None:
    PlainServer(ros.node("server"))
    client = ActionClient(ros.node("client"), Fibonacci, "fib")
    assert client.server_is_ready()
    seen: list[Any] = []
    sent = client.send_goal_async(Fibonacci.Goal(order=6), seen.append, NUMBER)
    ros.spin(sent.done)
    handle = sent.result()
    asked, cancelled = handle.get_result_async(), handle.cancel_goal_async()
    ros.spin(lambda: asked.done() and cancelled.done())
    assert [list(each.feedback.sequence) for each in seen] == [[6]]
    assert list(asked.result().result.sequence) == [8]
    assert [bytes(each.goal_id.uuid) for each in cancelled.result().goals_canceling] == [bytes(NUMBER.uuid)]


def test_server_works_with_a_plain_client(ros: Any) -> None:
    kept: list[Any] = []
    ActionServer(
        ros.node("server"),
        Fibonacci,
        "fib",
        lambda handle: handle.canceled() or Fibonacci.Result(sequence=[handle.request.order]),
        handle_accepted_callback=kept.append,
        cancel_callback=lambda handle: CancelResponse.ACCEPT,
    )
    node = ros.node("client")
    seen: list[Any] = []
    node.create_subscription(Impl.FeedbackMessage, "/fib/_action/feedback", seen.append, 10)
    goal = Fibonacci.Goal(order=6)
    response = ros.ask(node, Impl.SendGoalService, "/fib/_action/send_goal", goal_id=NUMBER, goal=goal)
    assert response.accepted
    assert response.stamp == kept[0]._goal_info.stamp
    kept[0].publish_feedback(Fibonacci.Feedback(sequence=[1]))
    ros.spin(lambda: bool(seen))
    assert bytes(seen[0].goal_id.uuid) == bytes(NUMBER.uuid)
    ros.ask(node, CancelGoal, "/fib/_action/cancel_goal", goal_info=GoalInfo(goal_id=NUMBER))
    kept[0].execute()
    answer = ros.ask(node, Impl.GetResultService, "/fib/_action/get_result", goal_id=NUMBER)
    assert (answer.status, list(answer.result.sequence)) == (GoalStatus.STATUS_CANCELED, [6])
