"""What rclpy 7.1 answers to arguments and prints for values, where a program can tell the difference."""

from __future__ import annotations

from typing import Any

import pytest
from rclpy.clock import ClockChange, JumpThreshold, ROSClock
from rclpy.clock_type import ClockType
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.event_handler import QoSPublisherEventType
from rclpy.logging import get_logger
from rclpy.qos import QoSCompatibility, QoSPresetProfiles, QoSProfile
from rclpy.service_introspection import ServiceIntrospectionState
from rclpy.signals import SignalHandlerOptions
from rclpy.time import Time
from rclpy.topic_endpoint_info import TopicEndpointInfo
from rclpy.utilities import timeout_sec_to_nsec
from std_msgs.msg import String
from std_srvs.srv import Trigger


@pytest.mark.parametrize(
    "member",
    [
        ClockChange.ROS_TIME_ACTIVATED,
        ClockType.ROS_TIME,
        QoSCompatibility.WARNING,
        QoSPublisherEventType.RCL_PUBLISHER_MATCHED,
        ServiceIntrospectionState.CONTENTS,
        SignalHandlerOptions.ALL,
    ],
)
def test_an_enumeration_of_the_c_extension_prints_its_name(member: Any) -> None:
    expected = f"{type(member).__name__}.{member.name}"
    assert (str(member), f"{member}") == (expected, expected)
    assert member == member.value


@pytest.mark.parametrize("profile", [10, "10", None])
def test_the_qos_of_a_service_is_a_profile_and_no_number(ros: Any, profile: Any) -> None:
    node = ros.node()
    refused = pytest.raises(AttributeError, match="object has no attribute 'get_c_qos_profile'")
    with refused:
        node.create_client(Trigger, "t", qos_profile=profile)
    with refused:
        node.create_service(Trigger, "t", lambda request, response: response, qos_profile=profile)
    assert node.create_client(Trigger, "t", qos_profile=QoSProfile(depth=10)).srv_name == "t"


def test_an_unknown_policy_is_named_among_all_that_were_given() -> None:
    with pytest.raises(AssertionError, match=r"constructor: dict_keys\(\['depth', 'reliable'\]\)"):
        QoSProfile(depth=1, reliable=True)


def test_the_durations_that_mean_best_available() -> None:
    from rclpy.qos import DeadlineBestAvailable, LivelinessLeaseDurationeBestAvailable

    best = QoSPresetProfiles.BEST_AVAILABLE.value
    assert best.deadline == DeadlineBestAvailable
    assert best.liveliness_lease_duration == LivelinessLeaseDurationeBestAvailable


def test_the_publisher_of_log_lines_is_not_among_the_node_s(ros: Any) -> None:
    node = ros.node()
    node.create_publisher(String, "t", 1)
    assert [each.topic_name for each in node.publishers] == ["/parameter_events", "/t"]


def test_a_node_keeps_its_handle(ros: Any) -> None:
    with pytest.raises(AttributeError, match=r"^handle cannot be modified after node creation$"):
        ros.node().handle = None


def test_a_namespace_that_is_no_text(ros: Any) -> None:
    with pytest.raises(TypeError, match="namespace must be a string, not int"):
        ros.node(namespace=3)


def test_a_context_may_be_told_not_to_set_up_the_log() -> None:
    context = Context()
    context.init([], initialize_logging=False)
    assert context.ok()
    context.shutdown()


@pytest.mark.parametrize("name", ["pre_callback", "post_callback"])
def test_what_is_called_at_a_jump_can_be_called(name: str) -> None:
    threshold: Any = JumpThreshold(min_forward=None, min_backward=None)
    with pytest.raises(ValueError, match=f"{name} must be callable if given"):
        ROSClock().create_jump_callback(threshold, **{name: 1})  # type: ignore[arg-type]


def test_a_change_of_the_source_tells_no_time() -> None:
    clock, jumps = ROSClock(), []
    clock.set_ros_time_override(Time(seconds=5))
    handle = clock.create_jump_callback(JumpThreshold(min_forward=None, min_backward=None), post_callback=jumps.append)
    clock._set_ros_time_is_active(True)
    clock._set_ros_time_is_active(False)
    handle.unregister()
    assert [(each.clock_change, each.delta) for each in jumps] == [
        (ClockChange.ROS_TIME_ACTIVATED, Duration()),
        (ClockChange.ROS_TIME_DEACTIVATED, Duration()),
    ]


def test_a_time_does_not_grow_beyond_its_64_bits() -> None:
    with pytest.raises(OverflowError, match="Total nanoseconds value is too large"):
        _ = Time(nanoseconds=2**63 - 1) - Duration(nanoseconds=-1)


@pytest.mark.parametrize(("seconds", "expected"), [(None, -1), (-0.5, -1), (0, 0), (1.5, 1_500_000_000)])
def test_a_time_out_for_ever_is_minus_one(seconds: float | None, expected: int) -> None:
    assert timeout_sec_to_nsec(seconds) == expected


def test_a_log_line_may_have_another_name(capfd: pytest.CaptureFixture[str]) -> None:
    logger = get_logger("first")
    for _ in range(2):
        assert logger.info("text", name="second")
    assert capfd.readouterr().err.count("[second]: text") == 2
    with pytest.raises(ValueError, match="Logger name cannot be changed between calls"):
        for name in ("third", "fourth"):
            logger.info("text", name=name)


def test_a_severity_is_given_once() -> None:
    with pytest.raises(TypeError, match="got multiple values for argument 'severity'"):
        get_logger("l").fatal("text", severity=10)


def test_a_throttle_is_a_number() -> None:
    with pytest.raises(TypeError, match="can't multiply sequence by non-int of type 'float'"):
        get_logger("l").info("text", throttle_duration_sec="1")


def test_an_endpoint_that_nothing_is_known_of() -> None:
    info = TopicEndpointInfo()
    assert info.qos_profile == QoSPresetProfiles.UNKNOWN.value
    assert "Topic type hash: INVALID" in str(info)
    with pytest.raises(AssertionError):
        info.endpoint_type = "PUBLISHER"  # type: ignore[assignment]
