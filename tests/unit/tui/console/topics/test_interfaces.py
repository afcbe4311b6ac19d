"""The classes of types by their names."""

from __future__ import annotations

import pytest
from bot_console.tui.console.topics.interfaces import interface
from bot_console.tui.console.topics.port import Payload
from example_interfaces.action import Fibonacci
from std_msgs.msg import String
from std_srvs.srv import Trigger


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("std_msgs/msg/String", String),
        ("std_msgs/String", String),
        ("example_interfaces/action/Fibonacci_FeedbackMessage", Fibonacci.Impl.FeedbackMessage),
        ("std_srvs/srv/Trigger_Event", Trigger.Event),
    ],
)
def test_messages_of_topics_include_feedback_of_actions_and_events_of_services(name: str, message: type) -> None:
    assert interface(Payload.MESSAGE, name) is message


@pytest.mark.parametrize(
    "name", ["nope_msgs/msg/X", "std_msgs/msg/X", "std_srvs/srv/Trigger", "x/action/Y_FeedbackMessage"]
)
def test_name_without_a_message_is_reported(name: str) -> None:
    with pytest.raises(ValueError, match="is not available here"):
        interface(Payload.MESSAGE, name)
