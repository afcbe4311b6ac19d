"""Alarms that are suggested while there are none: conditions over the topics that are there. Pure."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

from bot_console.tui.console.model import Endpoint
from bot_console.tui.panes.alarms.alarm import AlarmText

MAX_TEMPLATES = 12
_COLLISION = re.compile(r"bumper|collision|contact")
_BY_TYPE: Mapping[str, Mapping[str, str]] = {
    "sensor_msgs/msg/BatteryState": {"battery low": "{topic}/percentage < 0.2"},
    "sensor_msgs/msg/LaserScan": {
        "close to something": "min({topic}/ranges) < 0.3",
        "no scan": "rate({topic}) < 1",
    },
    "nav_msgs/msg/Odometry": {
        "stands still": "abs({topic}/twist.twist.linear.x) < 0.01",
        "no odometry": "rate({topic}) < 1",
    },
    "sensor_msgs/msg/Image": {"no picture": "rate({topic}) < 1"},
}
_BOOL: Mapping[str, str] = {"collision": "{topic}/data == true"}


def templates(topics: Iterable[Endpoint]) -> tuple[AlarmText, ...]:
    """Suggestions for these topics; several topics of a type follow in the order of their names."""
    found: dict[str, AlarmText] = {}
    for topic in sorted(topics, key=lambda each: (each.name.count("/"), each.name)):
        kind = topic.types[0] if topic.types else ""
        collides = kind == "std_msgs/msg/Bool" and _COLLISION.search(topic.name)
        for name, condition in (_BOOL if collides else _BY_TYPE.get(kind, {})).items():
            unique = name if name not in found else f"{name} {topic.name}"
            found[unique] = AlarmText(unique, condition.format(topic=topic.name))
    return tuple(found.values())[:MAX_TEMPLATES]
