"""The ROS packages that this project provides or has definitions of."""

from __future__ import annotations

from pathlib import Path

from bot_console.runtime import rosidl
from bot_console.runtime.importer import DEMOS, OWN_PACKAGES

RUNTIME = Path(__file__).resolve().parents[2] / "runtime"
OWN = {"bot_console", DEMOS, *OWN_PACKAGES}


def ros_names() -> set[str]:
    """The ROS names that the runtime serves: its own folders, generated interfaces, our packages."""
    generated = Path(rosidl.__file__).with_name("generated")  # of the installation: an sdist comes without
    places = RUNTIME, generated, RUNTIME / "rosidl" / "unverified"
    return {path.name for place in places for path in place.iterdir()} | OWN
