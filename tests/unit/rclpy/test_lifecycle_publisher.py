"""Publishers and other entities that follow their managed node."""

from __future__ import annotations

from typing import Any

import pytest
from rclpy.lifecycle import LifecycleNode, LifecyclePublisher, Publisher, SimpleManagedEntity
from std_msgs.msg import String


class Talk:
    """A managed node that publishes on `/chatter`, and a node that listens."""

    def __init__(self, ros: Any) -> None:
        self.ros = ros
        self.heard: list[str] = []
        ros.node("listener").create_subscription(String, "chatter", lambda message: self.heard.append(message.data), 10)
        self.node = LifecycleNode("talker", context=ros.context)
        self.publisher = self.node.create_lifecycle_publisher(String, "chatter", 10)

    def show_text(self, text: str) -> None:
        self.publisher.publish(String(data=text))
        self.ros.settle()


@pytest.fixture
def talk(ros: Any) -> Talk:
    return Talk(ros)


def test_messages_are_published_only_while_active(talk: Talk) -> None:
    assert Publisher is LifecyclePublisher
    steps = [
        (lambda: None, False),
        (talk.node.trigger_configure, False),
        (talk.node.trigger_activate, True),
        (talk.node.trigger_deactivate, False),
        (talk.node.trigger_activate, True),
        (talk.node.trigger_shutdown, True),
    ]
    for number, (step, activated) in enumerate(steps):
        step()
        assert talk.publisher.is_activated is activated
        talk.show_text(str(number))
    # As upstream: only deactivating silences a publisher, a shutdown of an active node does not.
    assert talk.heard == ["2", "4", "5"]


def test_publisher_created_while_active_is_silent_until_next_activation(talk: Talk) -> None:
    talk.node.trigger_configure()
    talk.node.trigger_activate()
    late = talk.node.create_lifecycle_publisher(String, "chatter", 10)
    late.publish(String(data="too early"))
    talk.node.trigger_deactivate()
    talk.node.trigger_activate()
    late.publish(String(data="now"))
    talk.ros.settle()
    assert talk.heard == ["now"]


def test_ordinary_publishers_of_a_managed_node_always_publish(talk: Talk) -> None:
    talk.node.create_publisher(String, "chatter", 10).publish(String(data="always"))
    talk.ros.settle()
    assert talk.heard == ["always"]


def test_publisher_class_cannot_be_chosen(talk: Talk) -> None:
    with pytest.raises(TypeError, match="unexpected keyword argument 'publisher_class'"):
        talk.node.create_lifecycle_publisher(String, "other", 10, publisher_class=LifecyclePublisher)


def test_destroyed_publisher_is_no_longer_managed(talk: Talk) -> None:
    assert talk.node.destroy_lifecycle_publisher(talk.publisher)
    assert not talk.node.destroy_lifecycle_publisher(talk.publisher)
    talk.node.trigger_configure()
    talk.node.trigger_activate()
    assert not talk.publisher.is_activated


def test_wrong_field_names_the_users_line(talk: Talk, capfd: pytest.CaptureFixture[str]) -> None:
    talk.node.trigger_configure()
    talk.node.trigger_activate()
    with pytest.raises(TypeError):
        talk.publisher.publish(String(data=5))  # type: ignore[arg-type]
    assert f", at {__file__}:" in capfd.readouterr().err


def test_when_enabled_runs_the_method_only_while_active() -> None:
    output: list[str] = []

    class Lamp(SimpleManagedEntity):
        @SimpleManagedEntity.when_enabled
        def shine(self, colour: str) -> None:
            output.append(colour)

        @SimpleManagedEntity.when_enabled(when_not_enabled=lambda: output.append("off"))
        def blink(self) -> None:
            output.append("blink")

    lamp = Lamp()
    for enabled in (False, True):
        if enabled:
            lamp.on_activate(None)  # type: ignore[arg-type]
        lamp.shine("red")
        lamp.blink()
    assert output == ["off", "red", "blink"]
    assert Lamp.shine.__name__ == "shine"
