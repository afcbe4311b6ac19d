"""The QoS of publishers as recorded in bags, and the QoS with which a player publishes."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import Any, cast

import yaml
from bot_console.tui.text.yaml_faults import UNREADABLE
from rclpy.duration import Duration
from rclpy.qos import DurabilityPolicy, HistoryPolicy, LivelinessPolicy, QoSProfile, ReliabilityPolicy

FOREVER = {"sec": 9223372036, "nsec": 854775807}
"""An infinite duration as ROS 2 writes it."""
POLICIES: Mapping[str, Any] = {
    "history": HistoryPolicy, "reliability": ReliabilityPolicy, "durability": DurabilityPolicy,
    "liveliness": LivelinessPolicy,
}  # fmt: skip
"""The policies that a file contains as words, by their names in the file."""
DEPTH = re.compile(r"[0-9]{1,9}")
"""A depth that a middleware can hold; anything else in a file is damage."""
DURATIONS = frozenset(["deadline", "lifespan", "liveliness_lease_duration"])


def offered_entries(profiles: Iterable[QoSProfile]) -> list[dict[str, Any]]:
    """Convert the profiles of publishers to entries of `offered_qos_profiles`."""
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


def compatible_profile(entries: Iterable[Mapping[str, Any]]) -> QoSProfile:
    """A profile compatible with every subscription that matched the recorded publishers.

    It is reliable or transient local if any of the publishers was.
    """
    found = list(entries)
    latching = any(each.get("durability") in ("transient_local", 1) for each in found)
    weak = bool(found) and all(each.get("reliability") in ("best_effort", 2) for each in found)
    depths = [int(each["depth"]) for each in found if DEPTH.fullmatch(str(each.get("depth", "")))]
    return QoSProfile(
        depth=max(depths, default=0) or 10,
        reliability=ReliabilityPolicy.BEST_EFFORT if weak else ReliabilityPolicy.RELIABLE,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if latching else DurabilityPolicy.VOLATILE,
    )


def read_overrides(text: str) -> dict[str, QoSProfile]:
    """Parse the file of `--qos-profile-overrides-path`: QoS profiles by topic, in YAML.

    Raises `ValueError` with a description of the error.
    """
    try:
        data: Any = yaml.safe_load(text)
    except UNREADABLE as error:
        raise ValueError(f"it is not YAML: {' '.join(str(error).split())}") from None
    if not isinstance(data, dict):
        raise ValueError("it has to map topics to QoS profiles")
    found = cast("dict[Any, Any]", data)
    return {f"/{str(topic).lstrip('/')}": _profile(str(topic), policies) for topic, policies in found.items()}


def _profile(topic: str, policies: Any) -> QoSProfile:
    if not isinstance(policies, dict):
        raise ValueError(f"{topic}: it has to map policies to values")
    given: dict[str, Any] = {}
    for name, value in cast("dict[str, Any]", policies).items():
        if name == "avoid_ros_namespace_conventions":
            continue
        if name not in (*POLICIES, *DURATIONS, "depth"):
            raise ValueError(f"{topic}: there is no policy '{str(name)[:40]}'")
        try:
            if name in POLICIES:
                given[name] = POLICIES[name][str(value).upper()]
            elif name in DURATIONS:
                given[name] = Duration(seconds=int(value["sec"]), nanoseconds=int(value["nsec"]))
            else:
                given[name] = max(0, int(value))
        except (KeyError, TypeError, ValueError, OverflowError):
            raise ValueError(f"{topic}: {name} cannot be '{str(value)[:40]}'") from None
    if "depth" not in given and given.get("history") != HistoryPolicy.KEEP_ALL:
        given["depth"] = 10
    return QoSProfile(**given)
