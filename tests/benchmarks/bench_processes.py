"""What messages cost between two processes: `python tests/benchmarks/bench_processes.py [COUNT]`, JSON out.

Each kind of message goes as bytes through a bare Zenoh session, which calls back from its own threads as it does in
rclpy, and then through rclpy, in the same run and with nothing dropped: messages/s until the last one is there,
processor time of both processes for one (us), and the round trip (us, median). `share` is rclpy's throughput as a part
of the bare one's, `longer` its round trip in those of the bare one.
A service call costs the processor time of both sides (us).
"""

from __future__ import annotations

import json
import os
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from typing import Any

from bot_console.runtime.importer import install

install()

import rclpy
import zenoh
from bot_console.runtime.rmw.middleware import choose_middleware
from bot_console.runtime.rmw.zenoh.domain.domain_bus import shared_bus
from bot_console.runtime.rmw.zenoh.domain.mesh import open_session
from example_interfaces.srv import AddTwoInts
from geometry_msgs.msg import Twist
from rclpy.qos import HistoryPolicy, QoSProfile
from rclpy.serialization import serialize_message
from sensor_msgs.msg import Image, LaserScan
from std_msgs.msg import String

SAMPLES = {
    "String": (String(data="sixteen letters!"), 1),
    "Twist": (Twist(), 1),
    "LaserScan": (LaserScan(ranges=[1.0] * 360, intensities=[2.0] * 360), 2),
    "Image": (Image(height=1000, width=1000, step=1000, data=bytes(1_000_000)), 250),
}
"""Messages, and by how much their number is divided."""

ALL = QoSProfile(history=HistoryPolicy.KEEP_ALL, depth=0)
BARE_DOMAIN, ROS_DOMAIN = 1, 0
ROUND_TRIPS = 300
CALLS = 500
PATIENCE = 60.0
Send = Callable[[], Any]


class Bare:
    """Bytes through Zenoh's own Python API, in a session with the settings and links of ours."""

    def __init__(self) -> None:
        self.session = open_session(BARE_DOMAIN)
        self.declared: list[Any] = []

    def publisher(self, name: str, topic: str) -> Send:
        payload = serialize_message(SAMPLES[name][0])
        publisher = self.session._zenoh.declare_publisher(
            f"{topic}/{name}", congestion_control=zenoh.CongestionControl.BLOCK, priority=zenoh.Priority.DATA_LOW
        )
        self.declared.append(publisher)
        return lambda: publisher.put(payload)

    def subscribe(self, name: str, topic: str, received: Send) -> None:
        def take(sample: zenoh.Sample) -> None:
            sample.payload.to_bytes()
            received()

        callback = zenoh.handlers.Callback(take, indirect=False)
        self.declared.append(self.session._zenoh.declare_subscriber(f"{topic}/{name}", callback))


class Ros:
    """Messages through rclpy, read on the other side."""

    def __init__(self) -> None:
        choose_middleware(shared_bus)
        rclpy.init(domain_id=ROS_DOMAIN)
        self.node = rclpy.create_node(f"bench_{os.getpid()}")

    def serve(self) -> None:
        threading.Thread(target=rclpy.spin, args=(self.node,), daemon=True).start()

    def publisher(self, name: str, topic: str) -> Send:
        message = SAMPLES[name][0]
        publisher = self.node.create_publisher(type(message), f"/{topic}/{name}", ALL)
        return lambda: publisher.publish(message)

    def subscribe(self, name: str, topic: str, received: Send) -> None:
        self.node.create_subscription(type(SAMPLES[name][0]), f"/{topic}/{name}", lambda message: received(), ALL)


def other(way: Bare | Ros) -> None:
    """The other process: counts, sends back, adds, and says for each line how many came and its processor time (s)."""
    counts = [0]

    def count() -> None:
        counts[0] += 1

    for name in SAMPLES:
        way.subscribe(name, "there", count)
        way.subscribe(name, "ping", way.publisher(name, "pong"))
    if isinstance(way, Ros):
        way.node.create_service(AddTwoInts, "/add", lambda request, response: response)
        way.serve()
    print("ready", flush=True)
    for _ in sys.stdin:
        print(json.dumps([counts[0], time.process_time()]), flush=True)


class Other:
    """That process as it is asked."""

    def __init__(self, way: str) -> None:
        command = [sys.executable, __file__, "--other", way]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self._line()

    def _line(self) -> str:
        assert self.process.stdout
        return self.process.stdout.readline()

    def state(self) -> tuple[int, float]:
        assert self.process.stdin
        self.process.stdin.write("\n")
        self.process.stdin.flush()
        count, spent = json.loads(self._line())
        return count, spent


def until(true: Callable[[], bool]) -> None:
    deadline = time.monotonic() + PATIENCE
    while not true():
        if time.monotonic() > deadline:
            raise TimeoutError
        time.sleep(0.002)


def throughput(send: Send, there: Other, count: int) -> dict[str, float]:
    until(lambda: bool(send()) or there.state()[0] > 0)  # until the two are linked
    time.sleep(0.5)
    before, spent = there.state()
    own, began = time.process_time(), time.perf_counter()
    for _ in range(count):
        send()
    until(lambda: there.state()[0] >= before + count)
    took = time.perf_counter() - began
    cost = time.process_time() - own + there.state()[1] - spent
    return {"per_s": round(count / took), "cpu_us": round(cost / count * 1e6, 1)}


def round_trip(way: Bare | Ros, name: str) -> float:
    back = threading.Event()
    way.subscribe(name, "pong", back.set)
    send = way.publisher(name, "ping")
    until(lambda: (send(), back.wait(0.05))[1])
    time.sleep(0.2)
    times: list[float] = []
    for _ in range(ROUND_TRIPS):
        back.clear()
        began = time.perf_counter()
        send()
        back.wait(PATIENCE)
        times.append(time.perf_counter() - began)
    return round(statistics.median(times) * 1e6)


def service(way: Ros, there: Other) -> float:
    client = way.node.create_client(AddTwoInts, "/add")
    until(client.service_is_ready)
    client.call(AddTwoInts.Request())
    spent, own = there.state()[1], time.process_time()
    for _ in range(CALLS):
        client.call(AddTwoInts.Request())
    return round((time.process_time() - own + there.state()[1] - spent) / CALLS * 1e6)


def main(count: int) -> None:
    os.environ["BOT_CONSOLE_SOCKET_DIR"] = os.path.join(tempfile.mkdtemp(prefix="bc-", dir="/tmp"), "s")
    others = {"bare": Other("bare"), "ros": Other("ros")}
    ros = Ros()
    ros.serve()
    ways: dict[str, Bare | Ros] = {"bare": Bare(), "ros": ros}
    figures: dict[str, Any] = {}
    for name, (_, divided) in SAMPLES.items():
        row: dict[str, Any] = {}
        for way, each in ways.items():
            row[way] = throughput(each.publisher(name, "there"), others[way], max(50, count // divided))
            row[way]["round_trip_us"] = round_trip(each, name)
        row["share"] = round(row["ros"]["per_s"] / row["bare"]["per_s"], 2)
        row["longer"] = round(row["ros"]["round_trip_us"] / row["bare"]["round_trip_us"], 2)
        figures[name] = row
    figures["service_call_cpu_us"] = service(ros, others["ros"])
    print(json.dumps(figures, indent=2), flush=True)
    for each in others.values():
        each.process.kill()
    os._exit(0)  # as the verbs end: without waiting for the sessions


if __name__ == "__main__":
    if sys.argv[1:2] == ["--other"]:
        other(Bare() if sys.argv[2] == "bare" else Ros())
    else:
        main(int(sys.argv[1]) if sys.argv[1:] else 10_000)
