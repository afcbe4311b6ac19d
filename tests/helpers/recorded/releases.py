"""Where a live rclpy differs from the recorded one, and the decision for each case."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

LIVE = Path(__file__).parents[2] / "contract" / "live"
"""`DISTRO.json`: the outcomes that differ from the recording; `decisions.yaml`: what the runtime does, and why."""

PYPI_TYPES = Path(__file__).with_name("pypi_types.py")
"""Executed before each case; it cannot be imported where the messages of PyPI are not installed."""


def absent_types(outcome: dict[str, Any]) -> bool:
    """Whether a case could not run because message types are missing."""
    return outcome.get("raises") == "ModuleNotFoundError" and "example_interfaces" in outcome["text"]


def as_recorded(outcome: dict[str, Any], recorded: dict[str, Any]) -> bool:
    """Whether an outcome equals the recorded one, apart from the package of a borrowed type."""
    return _comparable(outcome) == _comparable(recorded)


def _comparable(outcome: dict[str, Any]) -> Any:
    text = json.dumps({key: value for key, value in outcome.items() if key != "trace"}, sort_keys=True)
    return re.sub(r"\btest_msgs([./]action)", r"example_interfaces\1", text)
