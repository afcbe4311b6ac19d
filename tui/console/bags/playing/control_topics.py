"""Recognises recorded topics that command a robot, or that lock, release or acknowledge its stop. They are played only
on explicit request.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

COMMAND_TYPES = frozenset(
    {
        "geometry_msgs/msg/Twist",
        "geometry_msgs/msg/TwistStamped",
        "ackermann_msgs/msg/AckermannDrive",
        "ackermann_msgs/msg/AckermannDriveStamped",
        "trajectory_msgs/msg/JointTrajectory",
        "control_msgs/msg/JointJog",
    }
)
"""Types whose messages move a robot whatever the topic is called; the first two of them also identify robots."""
SURE_WORDS = frozenset(["cmd", "command", "commands", "release", "steer", "teleop"])
COMMAND_WORDS = frozenset(
    [
        "ack", "goal", "goals", "initialpose", "joy", "request", "reset", "route", "setpoint", "setpoints",
        "steering", "throttle", "trajectory", "waypoints",
    ]
)  # fmt: skip
STOP_WORDS = frozenset(
    [
        "brake", "brakes", "deadman", "disable", "disarm", "emergency", "enable", "freeze", "halt", "hold", "kill",
        "killswitch", "lock", "locked", "locks", "locking", "pause", "protective", "stop", "stopped", "unlock",
    ]
)  # fmt: skip
"""Words in the last part of a topic name: the locks of twist_mux, for example, are `pause_navigation` and `e_stop`.

`SURE_WORDS` count whatever the type, the others only if the type is not that of a measurement.
"""
WORD = re.compile(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])")
"""A word of a topic name, which may be numbered or in camel case."""
STOP_FOLDER = "emergency_stop"
FIGURES = re.compile(r"(std_msgs/msg/(U?Int|Float)|sensor_msgs/msg/(?!Joy$)|nav_msgs/msg/Odometry)")
"""Types of measurements: a counter named `stops`, or a laser scan, neither locks nor commands anything."""


def controls(topic: str, type_name: str) -> bool:
    """Whether messages on a topic command a robot, or lock, release or acknowledge its stop."""
    if type_name in COMMAND_TYPES:
        return True
    parts = [each for each in topic.split("/") if each]
    if STOP_FOLDER in parts[:-1]:
        return True
    last = parts[-1] if parts else ""
    words = {each.lower() for each in WORD.findall(last)}
    if last.lower().startswith("cmd") or words & SURE_WORDS:
        return True
    if FIGURES.match(type_name):
        return False
    return bool(words & (COMMAND_WORDS | STOP_WORDS)) or any(each.endswith("stop") for each in words)


def left_out_warning(topics: Sequence[str]) -> str:
    """The warning about topics that are left out when a bag is played."""
    names = " ".join(sorted(topics))
    return (
        f"Not played because they command a robot or concern its emergency stop: {names}. To play topics of this kind, "
        f"list every topic to play: --topics {names} ..."
    )
