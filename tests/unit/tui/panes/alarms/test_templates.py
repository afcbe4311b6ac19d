"""Suggested alarms: only for existing topics, each with a readable condition."""

from __future__ import annotations

from collections.abc import Mapping

from bot_console.tui.console.model import Endpoint
from bot_console.tui.panes.alarms.alarm import alarm_texts_in
from bot_console.tui.panes.alarms.templates import MAX_TEMPLATES, templates

KINDS = {
    "/battery_state": "sensor_msgs/msg/BatteryState",
    "/scan": "sensor_msgs/msg/LaserScan",
    "/odom": "nav_msgs/msg/Odometry",
    "/bumper": "std_msgs/msg/Bool",
    "/lights/on": "std_msgs/msg/Bool",
    "/camera/image": "sensor_msgs/msg/Image",
}


def topics(kinds: Mapping[str, str]) -> list[Endpoint]:
    return [Endpoint(name, (kind,)) for name, kind in kinds.items()]


def test_each_kind_of_topic_has_conditions_that_can_be_read() -> None:
    found = templates(topics(KINDS))
    assert [each.name for each in found if "rate(" in each.condition] == ["no odometry", "no scan", "no picture"]
    assert {"battery low", "close to something", "stands still", "collision"} <= {each.name for each in found}
    assert not any("/lights/on" in each.condition for each in found)
    assert len(alarm_texts_in([each.data for each in found])) == len(found), "an invalid condition is left out"


def test_names_are_unique_and_there_are_not_too_many() -> None:
    found = templates(topics({f"/robot{at}/scan": KINDS["/scan"] for at in range(30)}))
    assert len({each.name for each in found}) == len(found) == MAX_TEMPLATES
    assert templates([Endpoint("/odd", ())]) == ()


def test_topics_derived_from_a_suggested_topic_are_not_suggested() -> None:
    kinds = {
        "/ground_truth": KINDS["/odom"], "/odom": KINDS["/odom"], "/scan": KINDS["/scan"],
        "/scan_filtered": KINDS["/scan"], "/r2/scan": KINDS["/scan"], "/bumper": KINDS["/bumper"],
        "/lights": "std_msgs/msg/Bool",
    }  # fmt: skip
    found = templates(topics(kinds))
    assert [each.name for each in found] == [
        "collision", "stands still", "no odometry", "close to something", "no scan", "close to something /r2/scan",
        "no scan /r2/scan",
    ]  # fmt: skip
    assert not any("ground_truth" in each.condition or "filtered" in each.condition for each in found)
