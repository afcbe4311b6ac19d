"""The command line of `talker_qos` and `listener_qos`."""

from __future__ import annotations

import argparse

from rclpy.utilities import remove_ros_args

CYCLES = 20
"""After so many callbacks both end, unless another number is asked for."""


def qos_options(args: list[str] | None, cycles_text: str) -> tuple[bool, int]:
    """Whether it is to be reliable, and after how many callbacks it ends; other words end the program with usage."""
    parser = argparse.ArgumentParser(formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    parser.add_argument("--reliable", action="store_true", help="set qos profile to reliable")
    parser.add_argument("-n", "--number_of_cycles", type=int, default=CYCLES, help=cycles_text)
    words = remove_ros_args(args)
    found = parser.parse_args(words[1:] if args is None else words)
    return found.reliable, found.number_of_cycles
