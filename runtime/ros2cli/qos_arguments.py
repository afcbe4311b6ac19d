"""The `--qos-*` options that `topic echo` and `topic pub` share."""

from __future__ import annotations

import argparse
from typing import Any

from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    LivelinessPolicy,
    QoSPresetProfiles,
    QoSProfile,
    ReliabilityPolicy,
)

HISTORY = ("system_default", "keep_last", "keep_all", "unknown")
RELIABILITY = ("system_default", "reliable", "best_effort", "unknown", "best_available")
DURABILITY = ("system_default", "transient_local", "volatile", "unknown", "best_available")
LIVELINESS = ("system_default", "automatic", "manual_by_topic", "unknown", "best_available")
COMPATIBLE = "Compatible profile with running endpoints "
PROFILES = (
    "unknown",
    "default",
    "system_default",
    "sensor_data",
    "services_default",
    "parameters",
    "parameter_events",
    "action_status_default",
    "best_available",
)


def add_qos_arguments(parser: argparse.ArgumentParser, verb: str, default: str) -> None:
    """Add the options; `verb` is `subscribe` or `publish`."""

    def add(name: str, what: str, overrides: str, tail: str, **more: Any) -> None:
        text = f"{what} setting to {verb} with (overrides {overrides} value of --qos-profile option{tail}"
        parser.add_argument(f"--qos-{name}", help=text, **more)

    parser.add_argument(
        "--qos-profile",
        choices=PROFILES,
        help=f"Quality of service preset profile to {verb} with (default: {default})",
    )
    add("depth", "Queue size", "depth", ")", metavar="N", type=int)
    add("history", "History of samples", "history", ", default: keep_last)", choices=HISTORY)
    tail = f", default: {COMPATIBLE})"
    add("reliability", "Quality of service reliability", "reliability", tail, choices=RELIABILITY)
    add("durability", "Quality of service durability", "durability", tail, choices=DURABILITY)
    add("liveliness", "Quality of service liveliness", "liveliness", "", choices=LIVELINESS)
    add(
        "liveliness-lease-duration-seconds",
        "Quality of service liveliness lease duration",
        "liveliness lease duration",
        "",
        type=float,
    )


def profile(arguments: argparse.Namespace, default: str) -> QoSProfile:
    """The profile that the options ask for, on top of a preset."""
    name = arguments.qos_profile or default
    base: Any = QoSProfile(depth=10) if name in ("unknown", "default") else QoSPresetProfiles.get_from_short_key(name)
    changed = QoSProfile(
        history=base.history,
        depth=base.depth,
        reliability=base.reliability,
        durability=base.durability,
        liveliness=base.liveliness,
    )
    if arguments.qos_depth is not None:
        changed.depth = arguments.qos_depth
    for option, policy, attribute in (
        (arguments.qos_history, HistoryPolicy, "history"),
        (arguments.qos_reliability, ReliabilityPolicy, "reliability"),
        (arguments.qos_durability, DurabilityPolicy, "durability"),
        (arguments.qos_liveliness, LivelinessPolicy, "liveliness"),
    ):
        if option:
            setattr(changed, attribute, policy[option.upper()])
    return changed


def compatible(arguments: argparse.Namespace, default: str, publishers: Any) -> QoSProfile:
    """As `profile`, but where no option says otherwise, one that all the publishers of a topic satisfy."""
    chosen = profile(arguments, default)
    if arguments.qos_profile or arguments.qos_reliability or arguments.qos_durability or not publishers:
        return chosen
    reliable = all(each.qos_profile.reliability == ReliabilityPolicy.RELIABLE for each in publishers)
    lasting = all(each.qos_profile.durability == DurabilityPolicy.TRANSIENT_LOCAL for each in publishers)
    chosen.reliability = ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT
    chosen.durability = DurabilityPolicy.TRANSIENT_LOCAL if lasting else DurabilityPolicy.VOLATILE
    return chosen
