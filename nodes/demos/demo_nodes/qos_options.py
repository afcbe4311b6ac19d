"""The command line of `talker_qos` and `listener_qos`."""

from __future__ import annotations

import argparse

from rclpy.utilities import remove_ros_args

CYCLES = 20
"""Default number of callbacks after which both exit."""


def qos_options(args: list[str] | None, cycles_text: str) -> tuple[bool, int]:
    """Return whether to be reliable, and the number of callbacks; unknown arguments exit with the usage."""
    parser = argparse.ArgumentParser(formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    parser.add_argument("--reliable", action="store_true", help="set qos profile to reliable")
    parser.add_argument("-n", "--number_of_cycles", type=int, default=CYCLES, help=cycles_text)
    words = remove_ros_args(args)
    found = parser.parse_args(words[1:] if args is None else words)
    return found.reliable, found.number_of_cycles
