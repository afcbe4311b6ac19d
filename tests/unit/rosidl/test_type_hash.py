"""Type hashes compared with values published by ROS 2 systems and other implementations."""

from __future__ import annotations

import importlib
from typing import Any

import pytest
from bot_console.runtime.rosidl.type_description import describe
from bot_console.runtime.rosidl.type_hash import KNOWN, digest, digest_of_description, text
from example_interfaces.action import Fibonacci
from std_msgs.msg import Empty
from std_srvs.srv import Trigger

PUBLISHED = {
    "std_msgs/msg/String": "df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18",
    "sensor_msgs/msg/LaserScan": "64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828",
    "nav_msgs/msg/Goals": "02305a51633b5c04d8979b878a7577cafd422f8a07465c878b17a920af3759e9",
    "example_interfaces/srv/AddTwoInts": "e118de6bf5eeb66a2491b5bda11202e7b68f198d6f67922cf30364858239c81a",
}
WRONG_IN_ROSBAGS = ("std_msgs/msg/Char", "service_msgs/msg/ServiceEventInfo", "rmw_dds_common/msg/")
"""These have a `char`, which ROS 2 treats as `uint8`."""


def class_of(name: str) -> Any:
    package, kind, short = name.split("/")
    return getattr(importlib.import_module(f"{package}.{kind}"), short)


@pytest.mark.parametrize("name", PUBLISHED)
def test_hashes_equal_published_ones(name: str) -> None:
    assert text(class_of(name)) == f"RIHS01_{PUBLISHED[name]}"


def test_all_messages_have_the_hashes_of_rosbags() -> None:
    from bot_console.runtime.rosidl.texts import interface_names, standard_packages
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS2_JAZZY)
    checked = 0
    for package in standard_packages():
        for name in interface_names(package):
            full_name = f"{package}/{name}"
            if full_name in store.fielddefs and not full_name.startswith(WRONG_IN_ROSBAGS):
                assert text(class_of(full_name)) == store.hash_rihs01(full_name)
                checked += 1
    assert checked > 140


def test_empty_structure_has_a_member() -> None:
    (field,) = describe(Empty)["type_description"]["fields"]
    assert (field["name"], field["type"]["type_id"]) == ("structure_needs_at_least_one_member", 3)


def test_service_has_three_members() -> None:
    fields = describe(Trigger)["type_description"]["fields"]
    assert [each["name"] for each in fields] == ["request_message", "response_message", "event_message"]
    assert fields[2]["type"]["nested_type_name"] == "std_srvs/srv/Trigger_Event"


def test_action_has_its_services() -> None:
    description = describe(Fibonacci)
    assert [each["name"] for each in description["type_description"]["fields"]] == [
        "goal",
        "result",
        "feedback",
        "send_goal_service",
        "get_result_service",
        "feedback_message",
    ]
    names = [each["type_name"] for each in description["referenced_type_descriptions"]]
    assert names == sorted(names)
    assert "example_interfaces/action/Fibonacci_SendGoal_Event" in names


@pytest.mark.parametrize("name", KNOWN)
def test_stored_hashes_equal_computed_ones(name: str) -> None:
    assert digest_of_description(describe(class_of(name))).hex() == KNOWN[name] == digest(class_of(name)).hex()
