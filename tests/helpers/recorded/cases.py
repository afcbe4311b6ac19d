"""The recorded behaviour of real ROS 2, case by case, and the cases that differ here on purpose."""

from __future__ import annotations

import json
import os
from collections.abc import Collection, Mapping
from functools import cache
from pathlib import Path

import yaml

GIVEN = bool(os.environ.get("BOT_CONSOLE_ORACLE"))
RECORDINGS = Path(os.environ.get("BOT_CONSOLE_ORACLE", "")).absolute()
NOT_GIVEN = "BOT_CONSOLE_ORACLE names no recordings"
DIFFERS = Path(__file__).parents[2] / "acceptance" / "differs_on_purpose.yaml"


def recorded_areas() -> dict[str, list[str]]:
    """The ids of all recorded rclpy cases, by area; empty if there are no recordings."""
    if not GIVEN:
        return {}
    areas: dict[str, list[str]] = {}
    for case in json.loads((RECORDINGS / "rclpy" / "expected.json").read_text("utf-8"))["cases"]:
        areas.setdefault(case.partition("/")[0], []).append(case)
    return areas


@cache
def differing_on_purpose(kind: str) -> dict[str, str]:
    """The ids of cases of a kind (`rclpy`, `launch`, `cli`) that differ on purpose, with the reason for each."""
    listed: dict[str, dict[str, str]] = yaml.safe_load(DIFFERS.read_text("utf-8"))
    return listed[kind]


def faults(kind: str, replayed: Collection[str], differing: Mapping[str, object]) -> dict[str, object]:
    """The faults of a replay, by id: unlisted differences, and listed ones that no longer occur."""
    listed = differing_on_purpose(kind)
    found = {case: how for case, how in differing.items() if case not in listed}
    stale = (case for case in listed if case in replayed and case not in differing)
    return {**found, **dict.fromkeys(stale, f"is as recorded: remove it from {DIFFERS.name}")}
