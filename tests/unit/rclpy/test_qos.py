"""QoS profiles, presets and policies, and whether two profiles are compatible."""

from __future__ import annotations

from typing import Any

import pytest
import rclpy.qos as qos
from rclpy.duration import Duration
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    InvalidQoSProfileException,
    LivelinessPolicy,
    QoSCompatibility,
    QoSPresetProfiles,
    QoSProfile,
    ReliabilityPolicy,
    qos_check_compatible,
)


def test_profile_has_defaults() -> None:
    profile = QoSProfile(depth=7)
    assert (profile.history, profile.depth) == (HistoryPolicy.KEEP_LAST, 7)
    assert (profile.reliability, profile.durability) == (ReliabilityPolicy.RELIABLE, DurabilityPolicy.VOLATILE)
    assert profile.liveliness is LivelinessPolicy.SYSTEM_DEFAULT
    assert profile.lifespan == profile.deadline == profile.liveliness_lease_duration == Duration()
    assert profile.avoid_ros_namespace_conventions is False
    assert QoSProfile(history=HistoryPolicy.KEEP_ALL).depth == 10
    assert QoSProfile(depth=-1).depth == -1, "as upstream accepts it"


@pytest.mark.parametrize(
    ("policies", "kind"),
    [
        ({}, InvalidQoSProfileException),
        ({"history": HistoryPolicy.KEEP_LAST}, InvalidQoSProfileException),
        ({"depth": "5"}, AssertionError),
        ({"depth": 5.0}, AssertionError),
        ({"depth": 1, "reliability": "reliable"}, AssertionError),
        ({"depth": 1, "lifespan": 1.0}, AssertionError),
        ({"depth": 1, "speed": 1}, AssertionError),
        ({"depth": 1, "durability": 77}, ValueError),
    ],
)
def test_invalid_profiles_are_rejected(policies: dict[str, Any], kind: type[Exception]) -> None:
    with pytest.raises(kind):
        QoSProfile(**policies)


def test_policies_may_be_given_as_numbers() -> None:
    assert QoSProfile(history=2, reliability=2).reliability is ReliabilityPolicy.BEST_EFFORT


def test_profiles_compare_by_value_and_are_unhashable() -> None:
    assert QoSProfile(depth=1) == QoSProfile(depth=1) != QoSProfile(depth=2)
    assert QoSProfile(depth=1) != 1
    with pytest.raises(TypeError):
        hash(QoSProfile(depth=1))


def test_profile_prints_as_upstream() -> None:
    assert str(QoSProfile(depth=10)) == (
        "QoSProfile(history=1, depth=10, reliability=1, durability=2, lifespan=0 nanoseconds, deadline=0 nanoseconds, "
        "liveliness=0, liveliness_lease_duration=0 nanoseconds, avoid_ros_namespace_conventions=False)"
    )


PRESETS = {
    "default": (1, 10, 1, 2),
    "system_default": (0, 0, 0, 0),
    "sensor_data": (1, 5, 2, 2),
    "services_default": (1, 10, 1, 2),
    "parameters": (1, 1000, 1, 2),
    "parameter_events": (1, 1000, 1, 2),
    "action_status_default": (1, 1, 1, 1),
    "best_available": (1, 10, 4, 4),
    "unknown": (3, 0, 3, 3),
}


@pytest.mark.parametrize("key", PRESETS)
def test_presets_have_upstreams_values(key: str) -> None:
    found = QoSPresetProfiles.get_from_short_key(key)
    assert (found.history, found.depth, found.reliability, found.durability) == PRESETS[key]
    assert found == getattr(qos, f"qos_profile_{key}")


def test_presets_are_listed_by_key() -> None:
    assert sorted(QoSPresetProfiles.short_keys()) == sorted(PRESETS)
    with pytest.raises(KeyError):
        QoSPresetProfiles.get_from_short_key("nope")
    assert not hasattr(qos, "qos_profile_rosout_default")


@pytest.mark.parametrize(
    ("kind", "numbers"),
    [
        (HistoryPolicy, {"SYSTEM_DEFAULT": 0, "KEEP_LAST": 1, "KEEP_ALL": 2, "UNKNOWN": 3}),
        (
            ReliabilityPolicy,
            {"SYSTEM_DEFAULT": 0, "RELIABLE": 1, "BEST_EFFORT": 2, "UNKNOWN": 3, "BEST_AVAILABLE": 4},
        ),
        (
            DurabilityPolicy,
            {"SYSTEM_DEFAULT": 0, "TRANSIENT_LOCAL": 1, "VOLATILE": 2, "UNKNOWN": 3, "BEST_AVAILABLE": 4},
        ),
        (
            LivelinessPolicy,
            {"SYSTEM_DEFAULT": 0, "AUTOMATIC": 1, "MANUAL_BY_TOPIC": 3, "UNKNOWN": 4, "BEST_AVAILABLE": 5},
        ),
    ],
)
def test_policies_have_upstreams_names_and_numbers(kind: Any, numbers: dict[str, int]) -> None:
    assert {member.name: int(member) for member in kind} == numbers
    assert kind.short_keys() == [name.lower() for name in numbers]
    assert getattr(qos, f"QoS{kind.__name__}") is kind


def test_deprecated_names_warn() -> None:
    with pytest.warns(UserWarning, match="deprecated"):
        assert ReliabilityPolicy.RMW_QOS_POLICY_RELIABILITY_RELIABLE is ReliabilityPolicy.RELIABLE


def ms(number: int) -> Duration:
    return Duration(nanoseconds=number * 1_000_000)


BEST_EFFORT, LATCHED = {"reliability": ReliabilityPolicy.BEST_EFFORT}, {"durability": DurabilityPolicy.TRANSIENT_LOCAL}


@pytest.mark.parametrize(
    ("offered", "requested", "verdict", "words"),
    [
        ({}, {}, "OK", ""),
        ({}, BEST_EFFORT, "OK", ""),
        (BEST_EFFORT, {}, "ERROR", "ERROR: Best effort publisher and reliable subscription;"),
        ({}, LATCHED, "ERROR", "ERROR: Volatile publisher and transient local subscription;"),
        (LATCHED, {}, "OK", ""),
        ({}, {"deadline": ms(1)}, "ERROR", "ERROR: Subscription has a deadline, but publisher does not;"),
        (
            {"deadline": ms(2)},
            {"deadline": ms(1)},
            "ERROR",
            "ERROR: Subscription deadline is less than publisher deadline;",
        ),
        (
            {"reliability": ReliabilityPolicy.SYSTEM_DEFAULT},
            {},
            "WARNING",
            "WARNING: Reliable subscription, but publisher is system_default;",
        ),
        (
            {"durability": DurabilityPolicy.SYSTEM_DEFAULT},
            {"durability": DurabilityPolicy.UNKNOWN},
            "WARNING",
            "WARNING: Publisher durabilty is system_default and subscription durability is unknown;",
        ),
        (
            {"liveliness": LivelinessPolicy.SYSTEM_DEFAULT},
            {"liveliness": LivelinessPolicy.MANUAL_BY_TOPIC},
            "WARNING",
            "WARNING: Subscription's liveliness is manual by topic, but publisher's is system_default;",
        ),
        (
            {"liveliness_lease_duration": ms(2)},
            {"liveliness_lease_duration": ms(1)},
            "ERROR",
            "ERROR: Subscription liveliness lease duration is less than publisher;",
        ),
    ],
)
def test_compatibility_is_checked(offered: dict[str, Any], requested: dict[str, Any], verdict: str, words: str) -> None:
    alive = {"depth": 1, "liveliness": LivelinessPolicy.AUTOMATIC}
    found = qos_check_compatible(QoSProfile(**{**alive, **offered}), QoSProfile(**{**alive, **requested}))
    assert found == (QoSCompatibility[verdict], words)


def test_default_liveliness_gives_a_warning() -> None:
    assert qos_check_compatible(QoSProfile(depth=1), QoSProfile(depth=1)) == (
        QoSCompatibility.WARNING,
        "WARNING: Publisher liveliness is system_default and subscription liveliness is system_default;",
    )


@pytest.mark.parametrize(("given", "depth"), [(5, 5), (0, 0), (True, True), (QoSProfile(depth=3), 3)])
def test_integer_means_depth(ros: Any, given: Any, depth: int) -> None:
    from std_msgs.msg import String

    assert ros.node().create_publisher(String, "t", given).qos_profile.depth == depth


@pytest.mark.parametrize(
    ("given", "kind", "words"),
    [
        (-1, ValueError, "history depth must be greater than or equal to zero"),
        ("10", TypeError, "Expected QoSProfile or int, but received <class 'str'>"),
        (None, TypeError, "Expected QoSProfile or int, but received <class 'NoneType'>"),
    ],
)
def test_invalid_depths_are_rejected(ros: Any, given: Any, kind: type[Exception], words: str) -> None:
    from std_msgs.msg import String

    node = ros.node()
    for make in (
        lambda: node.create_publisher(String, "t", given),
        lambda: node.create_subscription(String, "t", print, given),
    ):
        with pytest.raises(kind) as caught:
            make()
        assert str(caught.value) == words


def test_zero_depth_is_warned_about() -> None:
    with pytest.warns(UserWarning, match="A zero depth with KEEP_LAST doesn't make sense; no data could be stored"):
        qos.QoSProfile(depth=0)


def test_profile_from_the_wire_is_returned_as_a_new_object_each_time():
    from bot_console.runtime.rmw.zenoh.wire.qos_text import decode_qos
    from rclpy.node_parts.graph import effective_profile

    first = effective_profile(decode_qos("2:1:,7:,:3,:,,"))
    assert (first.reliability, first.durability) == (ReliabilityPolicy.BEST_EFFORT, DurabilityPolicy.TRANSIENT_LOCAL)
    assert (first.depth, first.lifespan.nanoseconds // 10**9) == (7, 3)
    first.depth = 9
    assert effective_profile(decode_qos("2:1:,7:,:3,:,,")).depth == 7
