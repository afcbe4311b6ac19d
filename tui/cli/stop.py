"""`bot-console stop` and `bot-console release`: the robot's emergency stop without a screen."""

from __future__ import annotations

import argparse
import sys
import time

from bot_console.runtime.importer import install
from bot_console.tui.cli.domain import take_part

PATIENCE = 3.0
"""Seconds to find the robot and hear its answer."""


def run(verb: str, words: list[str]) -> int:
    """Lock or release every robot that is found; 0 when it has acknowledged, 1 when nothing has."""
    what = f"{verb.capitalize()} the robot, and wait for its word."
    parser = argparse.ArgumentParser(f"bot-console {verb}", description=what)
    if verb == "stop":
        parser.add_argument("reason", nargs="?", default="ALL STOP", help="why, for others to read")
    given = parser.parse_args(words)
    alone = take_part()
    if alone:
        print(alone, file=sys.stderr)
        return 1
    install()
    import rclpy
    from bot_console.tui.console.stop_link import STATUS, StopLink

    rclpy.init(args=[])
    node = rclpy.create_node("_bot_console_stop", enable_rosout=False, start_parameter_services=False)
    link = StopLink(node)
    if verb == "stop":
        link.stop(given.reason)
    deadline, done = time.monotonic() + PATIENCE, False
    while not done and time.monotonic() < deadline:
        names = node.get_topic_names_and_types()
        link.follow(name for name, types in names if STATUS in types and node.count_publishers(name))
        if verb == "release" and link.info.stopped and not link.releasing:
            link.release()
        link.repeat()
        for _ in range(10):
            rclpy.spin_once(node, timeout_sec=0.01)
        known = link.info.locks > 0 and link.heard
        done = known and (link.info.confirmed if verb == "stop" else not link.info.stopped)
    node.destroy_node()
    rclpy.try_shutdown()
    return _tell(verb, done, link.info.locks)


def _tell(verb: str, done: bool, locks: int) -> int:
    if done:
        print("held: the robot is locked until a person releases it" if verb == "stop" else "released")
        return 0
    why = "it has not answered" if locks else "no robot with an emergency stop was found (see docs/safety.md)"
    sent = "stop sent, not confirmed" if verb == "stop" else "not released"
    print(f"{sent}: {why}", file=sys.stderr)
    return 1
