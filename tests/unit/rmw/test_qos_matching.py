"""Which offers satisfy which requests, and which subscriptions get earlier messages."""

from __future__ import annotations

from typing import Any

import pytest
from bot_console.runtime.rmw.qos_matching import incompatible_policy, wants_history
from rclpy.duration import Duration, Infinite
from rclpy.qos import DurabilityPolicy, LivelinessPolicy, QoSProfile, ReliabilityPolicy, qos_profile_best_available

POLICIES = {"reliability": ReliabilityPolicy, "durability": DurabilityPolicy, "liveliness": LivelinessPolicy}


def qos(**policies: Any) -> QoSProfile:
    chosen = {name: POLICIES[name][value] if name in POLICIES else value for name, value in policies.items()}
    return QoSProfile(depth=1, **chosen)


def ms(number: int) -> Duration:
    return Duration(nanoseconds=number * 1_000_000)


@pytest.mark.parametrize(
    ("offered", "requested", "policy"),
    [
        ({}, {}, ""),
        ({"reliability": "RELIABLE"}, {"reliability": "BEST_EFFORT"}, ""),
        ({"reliability": "BEST_EFFORT"}, {"reliability": "RELIABLE"}, "RELIABILITY"),
        ({"reliability": "BEST_EFFORT"}, {"reliability": "BEST_AVAILABLE"}, ""),
        ({"durability": "TRANSIENT_LOCAL"}, {"durability": "VOLATILE"}, ""),
        ({"durability": "VOLATILE"}, {"durability": "TRANSIENT_LOCAL"}, "DURABILITY"),
        ({"durability": "BEST_AVAILABLE"}, {"durability": "TRANSIENT_LOCAL"}, ""),
        (
            {"reliability": "BEST_EFFORT", "durability": "VOLATILE"},
            {"reliability": "RELIABLE", "durability": "TRANSIENT_LOCAL"},
            "DURABILITY",
        ),
        ({"deadline": ms(10)}, {"deadline": ms(20)}, ""),
        ({"deadline": ms(20)}, {"deadline": ms(10)}, "DEADLINE"),
        ({}, {"deadline": ms(10)}, "DEADLINE"),
        ({"deadline": Infinite}, {"deadline": ms(10)}, "DEADLINE"),
        ({}, {"deadline": Infinite}, ""),
        ({"deadline": ms(10)}, {}, ""),
        ({"liveliness": "AUTOMATIC"}, {"liveliness": "MANUAL_BY_TOPIC"}, "LIVELINESS"),
        ({"liveliness": "MANUAL_BY_TOPIC"}, {"liveliness": "AUTOMATIC"}, ""),
        ({}, {"liveliness_lease_duration": ms(10)}, "LIVELINESS"),
        ({"lifespan": ms(1)}, {"lifespan": ms(9)}, ""),
    ],
)
def test_incompatible_policy_is_named(offered: dict[str, Any], requested: dict[str, Any], policy: str) -> None:
    assert incompatible_policy(qos(**offered), qos(**requested)) == policy


@pytest.mark.parametrize("offered", [{}, {"reliability": "BEST_EFFORT"}, {"durability": "TRANSIENT_LOCAL"}])
def test_best_available_accepts_every_offer(offered: dict[str, Any]) -> None:
    assert incompatible_policy(qos(**offered), qos_profile_best_available) == ""


@pytest.mark.parametrize(
    ("requested", "offers", "wanted"),
    [
        ("VOLATILE", ["TRANSIENT_LOCAL"], False),
        ("TRANSIENT_LOCAL", ["TRANSIENT_LOCAL"], True),
        ("BEST_AVAILABLE", ["TRANSIENT_LOCAL", "TRANSIENT_LOCAL"], True),
        ("BEST_AVAILABLE", ["TRANSIENT_LOCAL", "VOLATILE"], False),
    ],
)
def test_transient_local_subscriptions_get_earlier_messages(requested: str, offers: list[str], wanted: bool) -> None:
    assert wants_history(qos(durability=requested), [qos(durability=each) for each in offers]) == wanted
