"""Arguments accepted and texts printed by rclpy 7.1, where a program can notice a difference."""

from __future__ import annotations

from enum import IntEnum
from typing import Any

import pytest
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor
from rclpy._rclpy_pybind11 import RCLError, RMWError
from rclpy.clock import ClockChange, JumpThreshold, ROSClock
from rclpy.clock_type import ClockType
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.event_handler import QoSPublisherEventType
from rclpy.exceptions import InvalidParameterValueException
from rclpy.expand_topic_name import expand_topic_name
from rclpy.logging import get_logger
from rclpy.parameter import get_parameter_value
from rclpy.qos import QoSCompatibility, QoSPresetProfiles, QoSProfile, ReliabilityPolicy
from rclpy.service_introspection import ServiceIntrospectionState
from rclpy.signals import SignalHandlerOptions
from rclpy.time import Time
from rclpy.topic_endpoint_info import TopicEndpointInfo
from rclpy.utilities import timeout_sec_to_nsec
from rclpy.validate_full_topic_name import validate_full_topic_name
from rclpy.validate_namespace import validate_namespace
from rclpy.validate_node_name import validate_node_name
from rclpy.validate_topic_name import validate_topic_name
from std_msgs.msg import String
from std_srvs.srv import Trigger


@pytest.mark.parametrize(
    "member",
    [
        QoSCompatibility.WARNING,
        QoSPublisherEventType.RCL_PUBLISHER_MATCHED,
        ServiceIntrospectionState.CONTENTS,
        SignalHandlerOptions.ALL,
    ],
)
def test_enumeration_of_the_c_extension_prints_its_name(member: Any) -> None:
    expected = f"{type(member).__name__}.{member.name}"
    assert (str(member), f"{member}") == (expected, expected)
    assert member == member.value


@pytest.mark.parametrize("member", [ClockChange.ROS_TIME_ACTIVATED, ClockType.ROS_TIME])
def test_enumeration_of_rclpy_prints_as_in_this_python(member: Any) -> None:
    plain: Any = IntEnum(type(member).__name__, {member.name: member.value})
    plain = plain(member.value)
    assert (str(member), f"{member}", repr(member)) == (str(plain), f"{plain}", repr(plain))


@pytest.mark.parametrize("profile", [10, "10", None])
def test_service_qos_must_be_a_profile(ros: Any, profile: Any) -> None:
    node = ros.node()
    refused = pytest.raises(AttributeError, match="object has no attribute 'get_c_qos_profile'")
    with refused:
        node.create_client(Trigger, "t", qos_profile=profile)
    with refused:
        node.create_service(Trigger, "t", lambda request, response: response, qos_profile=profile)
    assert node.create_client(Trigger, "t", qos_profile=QoSProfile(depth=10)).srv_name == "t"


def test_unknown_policy_error_lists_all_given_ones() -> None:
    with pytest.raises(AssertionError, match=r"constructor: dict_keys\(\['depth', 'reliable'\]\)"):
        QoSProfile(depth=1, reliable=True)


def test_best_available_durations_are_upstreams() -> None:
    from rclpy.qos import DeadlineBestAvailable, LivelinessLeaseDurationeBestAvailable

    best = QoSPresetProfiles.BEST_AVAILABLE.value
    assert best.deadline == DeadlineBestAvailable
    assert best.liveliness_lease_duration == LivelinessLeaseDurationeBestAvailable


def test_rosout_publisher_is_not_among_the_nodes_publishers(ros: Any) -> None:
    node = ros.node()
    node.create_publisher(String, "t", 1)
    assert [each.topic_name for each in node.publishers] == ["/parameter_events", "/t"]


def test_handle_of_a_node_cannot_be_set(ros: Any) -> None:
    with pytest.raises(AttributeError, match=r"^handle cannot be modified after node creation$"):
        ros.node().handle = None


def test_namespace_must_be_a_string(ros: Any) -> None:
    with pytest.raises(TypeError, match="namespace must be a string, not int"):
        ros.node(namespace=3)


def test_name_of_none_is_refused_in_upstreams_words(ros: Any) -> None:
    node = ros.node()
    missing = "failed to validate name: topic_name argument is null"
    for call, error, text in (
        (lambda: ros.node(None), RCLError, "error creating node: name argument is null"),
        (lambda: node.create_publisher(String, None, 1), RCLError, missing),
        (lambda: node.create_subscription(String, None, print, 1), RCLError, missing),
        (lambda: validate_topic_name(None), RCLError, missing),
        (lambda: validate_full_topic_name(None), RMWError, "failed to validate name: error not set"),
        (lambda: validate_namespace(None), RMWError, "failed to validate namespace: error not set"),
        (lambda: validate_node_name(None), RMWError, "failed to validate node name: error not set"),
        (
            lambda: expand_topic_name(None, "n", "/"),
            RCLError,
            "failed to do name expansion: input_topic_name argument is null",
        ),
    ):
        with pytest.raises(error) as refused:
            call()
        assert str(refused.value) == text


def test_context_can_be_initialized_without_logging() -> None:
    context = Context()
    context.init([], initialize_logging=False)
    assert context.ok()
    context.shutdown()


NONE_CALLABLE = "One of pre_callback or post_callback must be callable"


@pytest.mark.parametrize(
    ("callbacks", "text"),
    [
        ({}, NONE_CALLABLE),
        ({"pre_callback": 1}, "pre_callback must be callable if given"),
        ({"post_callback": 1}, NONE_CALLABLE),
    ],
)
def test_jump_callback_must_be_callable(callbacks: dict[str, Any], text: str) -> None:
    threshold: Any = JumpThreshold(min_forward=None, min_backward=None)
    with pytest.raises(ValueError, match=text):
        ROSClock().create_jump_callback(threshold, **callbacks)


def test_callback_after_jumps_that_is_not_callable_counts_as_none() -> None:
    clock, jumps = ROSClock(), []
    clock.set_ros_time_override(Time(seconds=5))
    threshold = JumpThreshold(min_forward=None, min_backward=None)
    handle = clock.create_jump_callback(threshold, pre_callback=lambda: jumps.append("before"), post_callback=1)  # type: ignore[arg-type]
    clock._set_ros_time_is_active(True)
    assert jumps == ["before"]
    handle.unregister()


@pytest.mark.parametrize("threshold", [None, 5, "x", Duration(seconds=1)])
def test_invalid_jump_threshold_is_refused_at_once(threshold: Any) -> None:
    with pytest.raises(AttributeError, match="has no attribute 'min_forward'"):
        ROSClock().create_jump_callback(threshold, pre_callback=lambda: None)


def test_change_of_the_time_source_has_zero_delta() -> None:
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


def test_time_beyond_64_bits_overflows() -> None:
    with pytest.raises(OverflowError, match="Total nanoseconds value is too large"):
        _ = Time(nanoseconds=2**63 - 1) - Duration(nanoseconds=-1)


@pytest.mark.parametrize(("seconds", "expected"), [(None, -1), (-0.5, -1), (0, 0), (1.5, 1_500_000_000)])
def test_infinite_timeout_is_minus_one(seconds: float | None, expected: int) -> None:
    assert timeout_sec_to_nsec(seconds) == expected


def test_log_line_may_have_another_name(capfd: pytest.CaptureFixture[str]) -> None:
    logger = get_logger("first")
    for _ in range(2):
        assert logger.info("text", name="second")
    assert capfd.readouterr().err.count("[second]: text") == 2
    with pytest.raises(ValueError, match="Logger name cannot be changed between calls"):
        for name in ("third", "fourth"):
            logger.info("text", name=name)


def test_severity_cannot_be_given_twice() -> None:
    with pytest.raises(TypeError, match="got multiple values for argument 'severity'"):
        get_logger("l").fatal("text", severity=10)


def test_throttle_duration_must_be_a_number() -> None:
    with pytest.raises(TypeError, match="can't multiply sequence by non-int of type 'float'"):
        get_logger("l").info("text", throttle_duration_sec="1")


def test_unknown_endpoint_info_has_unknown_qos() -> None:
    info = TopicEndpointInfo()
    assert info.qos_profile == QoSPresetProfiles.UNKNOWN.value
    assert "Topic type hash: INVALID" in str(info)
    with pytest.raises(AssertionError):
        info.endpoint_type = "PUBLISHER"  # type: ignore[assignment]


@pytest.mark.parametrize("method", ["set_parameters", "get_parameter", "create_timer", "count_publishers"])
def test_missing_argument_error_names_the_node_method(ros: Any, method: str) -> None:
    with pytest.raises(TypeError, match=rf"^Node\.{method}\(\) missing 1 required positional argument"):
        getattr(ros.node(), method)(*(() if method != "create_timer" else (1.0,)))


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"throttle_duration_sec": 1.0, "throttle_time_source_type": None}, "throttle_time_source_type"),
        ({"throttle_duration_sec": None, "throttle_time_source_type": ROSClock()}, "throttle_duration_sec"),
    ],
)
def test_throttle_with_a_none_option_is_rejected(options: dict[str, Any], words: str) -> None:
    with pytest.raises(
        TypeError, match=f'^Required parameter "{words}" was not specified for logging filter "Throttle"$'
    ):
        get_logger("l").info("text", **options)


@pytest.mark.parametrize("options", [{"throttle_duration_sec": None}, {"throttle_time_source_type": None}])
def test_throttle_of_none_alone_does_not_throttle(options: dict[str, Any]) -> None:
    assert [get_logger("l").info("text", **options) for _ in range(2)] == [True, True]


def test_publishing_a_message_class_is_rejected(ros: Any) -> None:
    publisher = ros.node().create_publisher(String, "t", 1)
    with pytest.raises(TypeError, match=r"got <class 'std_msgs\.msg\._string\.Metaclass_String'>$"):
        publisher.publish(String)


@pytest.mark.parametrize("name", ["RMW_QOS_POLICY_RELIABILITY_NONE", "RELIABLEE"])
def test_unknown_policy_value_raises_attribute_error(name: str) -> None:
    with pytest.raises(AttributeError, match=rf"\b{name}'?$"):
        getattr(ReliabilityPolicy, name)


@pytest.mark.parametrize("text", [5, None, ["a"]])
def test_parameter_value_must_be_text(text: Any) -> None:
    with pytest.raises(AttributeError, match="object has no attribute 'read'"):
        get_parameter_value(text)


def test_prefix_of_none_is_rejected(ros: Any) -> None:
    with pytest.raises(TypeError, match="object of type 'NoneType' has no len"):
        ros.node().get_parameters_by_prefix(None)


def test_range_starting_with_nan_rejects_all_values(ros: Any) -> None:
    nothing = FloatingPointRange(from_value=float("nan"), to_value=1.0)
    with pytest.raises(InvalidParameterValueException, match=r"out of range Min: nan, Max: nan, value: 0\.5"):
        ros.node().declare_parameter("p", 0.5, ParameterDescriptor(floating_point_range=[nothing]))


def test_timeout_must_be_a_number(ros: Any) -> None:
    with pytest.raises(TypeError):
        ros.node().create_client(Trigger, "t").wait_for_service("1")


def test_dir_of_a_service_lists_its_parts_before_import() -> None:
    from nav_msgs.srv import GetPlan

    assert {"Event", "Request", "Response"} <= set(dir(GetPlan))


def test_goal_handles_print_the_module_of_their_import() -> None:
    from rclpy.action.client import ClientGoalHandle
    from rclpy.action.server import ServerGoalHandle

    assert str(ServerGoalHandle) == "<class 'rclpy.action.server.ServerGoalHandle'>"
    assert str(ClientGoalHandle) == "<class 'rclpy.action.client.ClientGoalHandle'>"


def test_on_shutdown_returns_nothing_and_requires_a_callable() -> None:
    context = Context()
    answers: list[Any] = [context.on_shutdown(lambda: None)]
    with pytest.raises(TypeError) as refused:
        context.on_shutdown(5)  # type: ignore[arg-type]
    assert answers == [None]
    assert refused.value.args == ("callback should be a callable, got {}", int)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"args": ("program",)}, "args must be a list of strings, not tuple"),
        ({"args": "program"}, "args must be a list of strings, not str"),
        ({"args": [], "domain_id": 1.0}, "domain_id must be an int, not float"),
        ({"args": [], "domain_id": "5"}, "'<' not supported between instances of 'str' and 'int'"),
    ],
)
def test_context_init_checks_argument_types(given: Any, words: str) -> None:
    context = Context()
    with pytest.raises(TypeError, match=words):
        context.init(**given)
    assert not context.ok()


def test_endpoint_info_error_lists_all_arguments() -> None:
    with pytest.raises(AssertionError, match=r"constructor: dict_keys\(\['node_name', 'nodename'\]\)"):
        TopicEndpointInfo(node_name="a", nodename="b")
