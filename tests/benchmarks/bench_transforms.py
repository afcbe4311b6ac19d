"""CPU time of the transform buffer: 1,000 frames at 100 Hz, and lookups; prints JSON.

The first share of a core is for adding the messages; the second includes their transport from a broadcaster.
"""

from __future__ import annotations

import gc
import json
import math
import time
from collections.abc import Callable
from typing import Any

from bot_console.runtime.importer import install

install()

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.time import Time
from tf2_msgs.msg import TFMessage
from tf2_ros import Buffer, TransformBroadcaster, TransformListener

FRAMES, RATE, SECONDS = 1000, 100, 6
CHAIN = 4


def message(at: float) -> Any:
    """All frames at a time (s), each turning in its parent, in chains of four."""
    turn = math.sin(at / 20), math.cos(at / 20)
    transforms = []
    for index in range(FRAMES):
        each = TransformStamped(child_frame_id=f"f{index}")
        each.header.frame_id = "odom" if index % CHAIN == 0 else f"f{index - 1}"
        each.header.stamp.sec, each.header.stamp.nanosec = int(at), round(at % 1 * 10**9)
        each.transform.rotation.z, each.transform.rotation.w = turn
        transforms.append(each)
    return TFMessage(transforms=transforms)


def cpu(act: Callable[[], Any], times: int = 1) -> float:
    """CPU time (s) of one call, the best of five rounds."""
    best = float("inf")
    for _ in range(5):
        begun = time.process_time()
        for _ in range(times):
            act()
        best = min(best, (time.process_time() - begun) / times)
    return best


def through_a_topic(messages: list[Any]) -> float:
    """Share of a core for broadcasting, delivering and adding messages at their rate."""
    rclpy.init()
    node = rclpy.create_node("bench_transforms")
    listener = TransformListener(Buffer(), node)
    broadcaster = TransformBroadcaster(node)
    begun = time.process_time()
    for each in messages:
        broadcaster.sendTransform(each.transforms)
        rclpy.spin_once(node, timeout_sec=0.1)
    used = time.process_time() - begun
    listener.unregister()
    rclpy.shutdown()
    return used * RATE / len(messages)


def main() -> None:
    """Measure and print."""
    messages = [message(1 + index / RATE) for index in range(RATE * SECONDS)]
    gc.freeze()  # No program holds millions of messages: the collector must not traverse those of the benchmark.
    buffer = Buffer()
    begun = time.process_time()
    for each in messages:
        buffer.take_messages(each.transforms)
    taken = time.process_time() - begun
    between, newest = Time(nanoseconds=4_005_000_000), Time()
    buffer.lookup_transform("f3", "f7", between)
    print(
        json.dumps(
            {
                "share of a core, 1000 frames at 100 Hz": round(taken / SECONDS, 4),
                "share of a core, with broadcaster and topic": round(through_a_topic(messages[: RATE * 2]), 4),
                "lookup of the newest, 4 frames us": round(
                    cpu(lambda: buffer.lookup_transform("odom", "f7", newest), 2000) * 1e6, 1
                ),
                "lookup between two times, 4 frames us": round(
                    cpu(lambda: buffer.lookup_transform("odom", "f7", between), 2000) * 1e6, 1
                ),
                "lookup between two times, 4 up and 4 down us": round(
                    cpu(lambda: buffer.lookup_transform("f3", "f7", between), 2000) * 1e6, 1
                ),
            },
            indent=1,
        )
    )


if __name__ == "__main__":
    main()
