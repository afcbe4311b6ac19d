"""The QoS of publishers as recorded in bags, and the QoS with which a player publishes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

FOREVER = {"sec": 9223372036, "nsec": 854775807}
"""How ROS 2 writes an infinite duration."""


def noted(profiles: Iterable[QoSProfile]) -> list[dict[str, Any]]:
    """Publisher profiles as entries of `offered_qos_profiles`."""
    return [
        {
            "history": "keep_last" if each.history == HistoryPolicy.KEEP_LAST else "keep_all",
            "depth": each.depth,
            "reliability": "best_effort" if each.reliability == ReliabilityPolicy.BEST_EFFORT else "reliable",
            "durability": "transient_local" if each.durability == DurabilityPolicy.TRANSIENT_LOCAL else "volatile",
            "deadline": FOREVER,
            "lifespan": FOREVER,
            "liveliness": "automatic",
            "liveliness_lease_duration": FOREVER,
            "avoid_ros_namespace_conventions": False,
        }
        for each in profiles
    ]


def offered(entries: Iterable[Mapping[str, Any]]) -> QoSProfile:
    """A profile compatible with every subscription of the recorded publishers: reliable or latched if any of them
    was.
    """
    found = list(entries)
    latching = any(each.get("durability") in ("transient_local", 1) for each in found)
    weak = bool(found) and all(each.get("reliability") in ("best_effort", 2) for each in found)
    depths = [int(each["depth"]) for each in found if str(each.get("depth", "")).isdigit()]
    return QoSProfile(
        depth=max(depths, default=0) or 10,
        reliability=ReliabilityPolicy.BEST_EFFORT if weak else ReliabilityPolicy.RELIABLE,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if latching else DurabilityPolicy.VOLATILE,
    )
