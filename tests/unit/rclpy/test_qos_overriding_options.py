"""QoS policies overridden by parameters."""

from typing import Any

import pytest
from rclpy.duration import Duration
from rclpy.exceptions import InvalidParameterTypeException
from rclpy.qos import HistoryPolicy, QoSPolicyKind, QoSProfile, ReliabilityPolicy
from rclpy.qos_overriding_options import InvalidQosOverridesError, QoSOverridingOptions
from std_msgs.msg import String

DEFAULTS = QoSOverridingOptions.with_default_policies()


def overrides(node: Any) -> dict[str, Any]:
    return {name: each.value for name, each in node.get_parameters_by_prefix("qos_overrides").items()}


def test_default_policies_of_a_publisher_can_be_overridden(ros: Any) -> None:
    ros.init(
        "-p",
        "qos_overrides./chatter.publisher.depth:=3",
        "-p",
        "qos_overrides./chatter.publisher.reliability:=best_effort",
    )
    node = ros.node()
    given = QoSProfile(depth=10)
    publisher = node.create_publisher(String, "chatter", given, qos_overriding_options=DEFAULTS)
    assert overrides(node) == {
        "/chatter.publisher.history": "keep_last",
        "/chatter.publisher.depth": 3,
        "/chatter.publisher.reliability": "best_effort",
    }
    found = publisher.qos_profile
    assert (found.depth, found.history, found.reliability) == (
        3,
        HistoryPolicy.KEEP_LAST,
        ReliabilityPolicy.BEST_EFFORT,
    )
    assert given.depth == 10
    described = node.describe_parameter("qos_overrides./chatter.publisher.depth")
    assert described.read_only
    assert described.description == "depth for publisher `/chatter` with id `None`"


def test_entity_id_and_durations_are_supported(ros: Any) -> None:
    kinds = (QoSPolicyKind.LIFESPAN, QoSPolicyKind.DEADLINE, QoSPolicyKind.DURABILITY)
    ros.init("-p", "qos_overrides./t.subscription_left.deadline:=5000")
    node = ros.node()
    options = QoSOverridingOptions(kinds, entity_id="left")
    subscription = node.create_subscription(String, "t", print, 10, qos_overriding_options=options)
    assert list(overrides(node)) == ["/t.subscription_left.deadline", "/t.subscription_left.durability"]
    assert subscription.qos_profile.deadline == Duration(nanoseconds=5000)
    publisher = node.create_publisher(String, "t", 10, qos_overriding_options=options)
    assert publisher.qos_profile.lifespan == Duration()
    assert len(overrides(node)) == 5


def test_second_entity_uses_the_declared_values(ros: Any) -> None:
    ros.init("-p", "qos_overrides./t.publisher.depth:=3")
    node = ros.node()
    for depth in (10, 20):
        assert node.create_publisher(String, "t", depth, qos_overriding_options=DEFAULTS).qos_profile.depth == 3


def test_invalid_overrides_are_rejected(ros: Any) -> None:
    ros.init("-p", "qos_overrides./t.publisher.reliability:=sometimes", "-p", "qos_overrides./u.publisher.depth:=many")
    node = ros.node()
    with pytest.raises(RuntimeError, match=r"^Unexpected QoS override for policy `reliability`: `sometimes`$"):
        node.create_publisher(String, "t", 10, qos_overriding_options=DEFAULTS)
    with pytest.raises(InvalidParameterTypeException):
        node.create_publisher(String, "u", 10, qos_overriding_options=DEFAULTS)
    strict = QoSOverridingOptions([QoSPolicyKind.DEPTH], callback=lambda qos: qos.depth < 5)
    with pytest.raises(
        InvalidQosOverridesError, match=r"^Provided QoS overrides for publisher `/v` with id `None`, are not valid$"
    ):
        node.create_publisher(String, "v", 10, qos_overriding_options=strict)


def test_nothing_is_declared_without_the_option(ros: Any) -> None:
    ros.init("-p", "qos_overrides./t.publisher.depth:=3")
    node = ros.node()
    assert node.create_publisher(String, "t", 10).qos_profile.depth == 10
    assert overrides(node) == {}


def test_validation_callback_gives_the_reason_of_a_refusal(ros: Any) -> None:
    from rclpy.qos_overriding_options import QosCallbackResult

    def shallow(profile: QoSProfile) -> Any:
        return QosCallbackResult(successful=profile.depth > 5, reason="too shallow")

    options = QoSOverridingOptions.with_default_policies(callback=shallow)
    ros.node().create_publisher(String, "deep", 10, qos_overriding_options=options)
    with pytest.raises(InvalidQosOverridesError, match="are not valid: too shallow"):
        ros.node("m").create_publisher(String, "shallow", 1, qos_overriding_options=options)
