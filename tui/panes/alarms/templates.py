"""The alarms that are suggested while there are none: conditions over the existing topics. Pure."""

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
    """Suggested alarms for these topics, topics in the fewest namespaces first, then in order of name.

    In each namespace, only the topic with the shortest name is used of each type: the others are mostly derived from
    it, such as `/scan_filtered` from `/scan`, and every suggestion costs a subscription.
    """
    chosen: dict[tuple[str, str], str] = {}
    for topic in sorted(topics, key=lambda each: (len(each.name), each.name)):
        kind = topic.types[0] if topic.types else ""
        if _conditions(topic.name, kind):
            chosen.setdefault((topic.name.rpartition("/")[0], kind), topic.name)
    found: dict[str, AlarmText] = {}
    for (_, kind), topic in sorted(chosen.items(), key=lambda each: (each[1].count("/"), each[1])):
        for name, condition in _conditions(topic, kind).items():
            unique = name if name not in found else f"{name} {topic}"
            found[unique] = AlarmText(unique, condition.format(topic=topic))
    return tuple(found.values())[:MAX_TEMPLATES]


def _conditions(topic: str, kind: str) -> Mapping[str, str]:
    """The conditions suggested for a topic, by name."""
    if kind == "std_msgs/msg/Bool":
        return _BOOL if _COLLISION.search(topic) else {}
    return _BY_TYPE.get(kind, {})
