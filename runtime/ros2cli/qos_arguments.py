"""The `--qos-*` options that `topic echo` and `topic pub` share."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from typing import Any

from rclpy.duration import Duration
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    LivelinessPolicy,
    QoSPresetProfiles,
    QoSProfile,
    ReliabilityPolicy,
)

COMPATIBLE = "Compatible profile with running endpoints "


def add_qos_arguments(parser: argparse.ArgumentParser, verb: str, default: str) -> None:
    """Add the QoS options; `verb` is `subscribe` or `publish`."""

    def add(name: str, what: str, overrides: str, tail: str, **more: Any) -> None:
        text = f"{what} setting to {verb} with (overrides {overrides} value of --qos-profile option{tail}"
        parser.add_argument(f"--qos-{name}", help=text, **more)

    parser.add_argument(
        "--qos-profile",
        choices=QoSPresetProfiles.short_keys(),
        help=f"Quality of service preset profile to {verb} with (default: {default})",
    )
    add("depth", "Queue size", "depth", ")", metavar="N", type=int)
    add("history", "History of samples", "history", ", default: keep_last)", choices=HistoryPolicy.short_keys())
    tail = f", default: {COMPATIBLE})"
    add("reliability", "Quality of service reliability", "reliability", tail, choices=ReliabilityPolicy.short_keys())
    add("durability", "Quality of service durability", "durability", tail, choices=DurabilityPolicy.short_keys())
    add("liveliness", "Quality of service liveliness", "liveliness", "", choices=LivelinessPolicy.short_keys())
    add(
        "liveliness-lease-duration-seconds",
        "Quality of service liveliness lease duration",
        "liveliness lease duration",
        "",
        type=float,
    )


def profile(arguments: argparse.Namespace, default: str) -> QoSProfile:
    """Return the profile that the options select: a preset in which the given policies are changed."""
    changed = _preset(arguments.qos_profile or default)
    for option, policy, attribute in (
        (arguments.qos_history, HistoryPolicy, "history"),
        (arguments.qos_reliability, ReliabilityPolicy, "reliability"),
        (arguments.qos_durability, DurabilityPolicy, "durability"),
        (arguments.qos_liveliness, LivelinessPolicy, "liveliness"),
    ):
        if option:
            setattr(changed, attribute, policy[option.upper()])
    lease: float = arguments.qos_liveliness_lease_duration_seconds or 0
    if lease > 0:
        changed.liveliness_lease_duration = Duration(seconds=lease)
    depth: int = arguments.qos_depth or 0  # as upstream, 0 and less keep the preset's depth
    if depth > 0:
        changed.depth = depth
    elif changed.durability == DurabilityPolicy.TRANSIENT_LOCAL and changed.depth == 0:
        changed.depth = 1
    return changed


def _preset(name: str) -> QoSProfile:
    """Return a copy of a preset, which the caller may change."""
    base: Any = QoSProfile(depth=10) if name in ("unknown", "default") else QoSPresetProfiles.get_from_short_key(name)
    return QoSProfile(
        history=base.history,
        depth=base.depth,
        reliability=base.reliability,
        durability=base.durability,
        liveliness=base.liveliness,
    )


def compatible_profile(arguments: argparse.Namespace, default: str, publishers: Any) -> QoSProfile:
    """Return the profile of the options, or, with at most a preset given, one compatible with all publishers of a
    topic.

    Prints a notice if some publishers offer a stronger policy than the one chosen.
    """
    chosen = profile(arguments, default)
    settings = ("depth", "history", "reliability", "durability", "liveliness", "liveliness_lease_duration_seconds")
    if not publishers or any(getattr(arguments, f"qos_{each}") is not None for each in settings):
        return chosen
    offers = [each.qos_profile for each in publishers]
    chosen.reliability = _offered_by_all(
        [each.reliability for each in offers], ReliabilityPolicy.RELIABLE, ReliabilityPolicy.BEST_EFFORT
    )
    chosen.durability = _offered_by_all(
        [each.durability for each in offers], DurabilityPolicy.TRANSIENT_LOCAL, DurabilityPolicy.VOLATILE
    )
    return chosen


def _offered_by_all(offers: Sequence[Any], best: Any, fallback: Any) -> Any:
    """Return `best` if all publishers offer it, otherwise `fallback`."""
    count = offers.count(best)
    if count == len(offers):
        return best
    if count:
        kind = f"QoS{type(best).__name__.removeprefix('QoS')}"
        print(
            f"Some, but not all, publishers are offering {kind}.{best.name}. Falling back to {kind}.{fallback.name} "
            "as it will connect to all publishers"
        )
    return fallback
