"""The cost of messages between two processes: `python tests/benchmarks/bench_processes.py [COUNT]`, JSON out.

Each kind of message goes through a bare Zenoh session and through rclpy, which serializes each one as CDR on this side
and deserializes it on the other. Both are measured in the same run with nothing dropped (KEEP_ALL): messages/s until
the last one has arrived, CPU time per message of each process (us), and the round trip (us); medians of alternating
rounds. The figures include everything that rclpy does beyond the bare session: its executor's thread for receiving, and
with KEEP_ALL a thread for sending, since publishers must not wait for readers.

The bare session is used in three ways. `bare` sends bytes that are made once and reads nothing; as is Zenoh's default
for a plain function, a Python thread calls back for everything that has arrived meanwhile. `written` also writes and
reads the CDR of each message, as rclpy must. `direct` is `bare` with callbacks from Zenoh's own threads, as in rclpy's
subscriptions. `share` is rclpy's throughput divided by theirs, `longer` its round trip divided by theirs; `ros_10` is
rclpy with a depth of 10, as nodes use it, where nothing waits to be sent.

A service call is given as the CPU time of both sides (us, the median of ten times fifty).
"""

from __future__ import annotations

import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Mapping, Sequence
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
from rclpy.serialization import deserialize_message, serialize_message
from sensor_msgs.msg import Image, LaserScan
from std_msgs.msg import String

SAMPLES = {
    "String": (String(data="sixteen letters!"), 1),
    "Twist": (Twist(), 1),
    "LaserScan": (LaserScan(ranges=[1.0] * 360, intensities=[2.0] * 360), 2),
    "Image": (Image(height=1000, width=1000, step=1000, data=bytes(1_000_000)), 250),
}
"""Messages, and the divisor for their number."""

ALL = QoSProfile(history=HistoryPolicy.KEEP_ALL, depth=0)
BARE = ("bare", "written", "direct")
PROFILES = {"ros": ALL, "ros_10": QoSProfile(depth=10)}
"""The ways to use bare Zenoh, and the profiles for rclpy."""
BARE_DOMAIN, ROS_DOMAIN = 1, 0
ROUNDS = 3
ROUND_TRIPS = 100
CALLS = 50
TIMEOUT_S = 60.0
Send = Callable[[], Any]


class Bare:
    """Messages through Zenoh's own Python API, in a session with our settings and links."""

    def __init__(self) -> None:
        self.session = open_session(BARE_DOMAIN)
        self.declared: list[Any] = []

    def publisher(self, kind: str, name: str, topic: str) -> Send:
        message = SAMPLES[name][0]
        payload = serialize_message(message)
        publisher = self.session._zenoh.declare_publisher(
            f"{kind}/{topic}/{name}", congestion_control=zenoh.CongestionControl.BLOCK, priority=zenoh.Priority.DATA_LOW
        )
        self.declared.append(publisher)
        if kind == "written":
            return lambda: publisher.put(serialize_message(message))
        return lambda: publisher.put(payload)

    def subscribe(self, kind: str, name: str, topic: str, received: Send) -> None:
        message_class = type(SAMPLES[name][0])

        def take(sample: zenoh.Sample) -> None:
            data = sample.payload.to_bytes()
            if kind == "written":
                deserialize_message(data, message_class)
            received()

        callback = zenoh.handlers.Callback(take, indirect=False) if kind == "direct" else take
        self.declared.append(self.session._zenoh.declare_subscriber(f"{kind}/{topic}/{name}", callback))


class Ros:
    """Messages through rclpy, read on the other side."""

    def __init__(self) -> None:
        choose_middleware(shared_bus)
        rclpy.init(domain_id=ROS_DOMAIN)
        self.node = rclpy.create_node(f"bench_{os.getpid()}")

    def serve(self) -> None:
        threading.Thread(target=rclpy.spin, args=(self.node,), daemon=True).start()

    def publisher(self, kind: str, name: str, topic: str) -> Send:
        message = SAMPLES[name][0]
        publisher = self.node.create_publisher(type(message), f"/{kind}/{topic}/{name}", PROFILES[kind])
        return lambda: publisher.publish(message)

    def subscribe(self, kind: str, name: str, topic: str, received: Send) -> None:
        def take(message: Any) -> None:
            received()

        self.node.create_subscription(type(SAMPLES[name][0]), f"/{kind}/{topic}/{name}", take, PROFILES[kind])


def run_other_process(way: Bare | Ros, kinds: Sequence[str]) -> None:
    """The other process: it counts, sends back, and adds.

    Each line it reads is a number of messages: once that many have arrived, it prints how many did and its CPU time
    (s). It
    is not queried meanwhile, which would slow down the slower of the two ways more.
    """
    counts = [0]
    wanted = [0]
    reached = threading.Event()

    def count() -> None:
        counts[0] += 1
        if counts[0] == wanted[0]:
            reached.set()

    for kind in kinds:
        for name in SAMPLES:
            way.subscribe(kind, name, "there", count)
            way.subscribe(kind, name, "ping", way.publisher(kind, name, "pong"))
    if isinstance(way, Ros):
        way.node.create_service(AddTwoInts, "/add", lambda request, response: response)
        way.serve()
    print("ready", flush=True)
    for line in sys.stdin:
        reached.clear()
        wanted[0] = int(line)
        if counts[0] < wanted[0]:
            reached.wait(TIMEOUT_S)
        print(json.dumps([counts[0], time.process_time()]), flush=True)


class OtherProcess:
    """The other process, seen from this one."""

    def __init__(self, way: str) -> None:
        command = [sys.executable, __file__, "--other", way]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self._line()

    def _line(self) -> str:
        assert self.process.stdout
        return self.process.stdout.readline()

    def state(self, wanted: int = 0) -> tuple[int, float]:
        assert self.process.stdin
        self.process.stdin.write(f"{wanted}\n")
        self.process.stdin.flush()
        count, spent = json.loads(self._line())
        return count, spent


def until(true: Callable[[], bool]) -> None:
    deadline = time.monotonic() + TIMEOUT_S
    while not true():
        if time.monotonic() > deadline:
            raise TimeoutError
        time.sleep(0.002)


class Pair:
    """One kind of message between the two processes, sent in one way."""

    def __init__(self, way: Bare | Ros, kind: str, name: str, there: OtherProcess) -> None:
        self._there = there
        self._send = way.publisher(kind, name, "there")
        self._ping = way.publisher(kind, name, "ping")
        self._back = threading.Event()
        way.subscribe(kind, name, "pong", self._back.set)
        before = there.state()[0]
        until(lambda: bool(self._send()) or there.state()[0] > before)  # Until the two are connected.
        until(lambda: (self._ping(), self._back.wait(0.05))[1])
        time.sleep(0.3)
        self._times: list[float] = []
        self._rates: list[float] = []
        self._costs: list[tuple[float, float]] = []

    def throughput(self, count: int) -> None:
        before, spent = self._there.state()
        own, began = time.process_time(), time.perf_counter()
        for _ in range(count):
            self._send()
        came, end = self._there.state(before + count)
        if came < before + count:
            raise TimeoutError
        self._rates.append(count / (time.perf_counter() - began))
        self._costs.append(((time.process_time() - own) / count, (end - spent) / count))

    def round_trips(self) -> None:
        for _ in range(ROUND_TRIPS):
            self._back.clear()
            began = time.perf_counter()
            self._ping()
            self._back.wait(TIMEOUT_S)
            self._times.append(time.perf_counter() - began)

    def figures(self) -> dict[str, float]:
        found: dict[str, float] = {"round_trip_us": round(statistics.median(self._times) * 1e6)}
        if self._rates:
            found["per_s"] = round(statistics.median(self._rates))
            for side, costs in zip(("sender", "receiver"), zip(*self._costs, strict=True), strict=True):
                found[f"{side}_cpu_us"] = round(statistics.median(costs) * 1e6, 1)
        return found


def service(way: Ros, there: OtherProcess) -> float:
    client = way.node.create_client(AddTwoInts, "/add")
    until(client.service_is_ready)
    client.call(AddTwoInts.Request())
    costs: list[float] = []
    for _ in range(10):
        spent, own = there.state()[1], time.process_time()
        for _ in range(CALLS):
            client.call(AddTwoInts.Request())
        costs.append((time.process_time() - own + there.state()[1] - spent) / CALLS)
    return round(statistics.median(costs) * 1e6)


def compared(pairs: Mapping[str, Pair]) -> dict[str, Any]:
    row: dict[str, Any] = {kind: pair.figures() for kind, pair in pairs.items()}
    for kind in BARE:
        row[f"share of {kind}"] = round(row["ros"]["per_s"] / row[kind]["per_s"], 2)
        for ros in PROFILES:
            longer = row[ros]["round_trip_us"] / row[kind]["round_trip_us"]
            row[f"{ros} longer than {kind}"] = round(longer, 2)
    return row


def main(count: int) -> None:
    folder = tempfile.mkdtemp(prefix="bc-", dir="/tmp")
    os.environ["BOT_CONSOLE_SOCKET_DIR"] = os.path.join(folder, "s")
    others = {way: OtherProcess(way) for way in ("bare", "ros")}
    ros, bare = Ros(), Bare()
    ros.serve()
    figures: dict[str, Any] = {}
    for name, (_, divided) in SAMPLES.items():
        pairs = {kind: Pair(bare, kind, name, others["bare"]) for kind in BARE}
        pairs |= {kind: Pair(ros, kind, name, others["ros"]) for kind in PROFILES}
        for _ in range(ROUNDS):
            for kind, pair in pairs.items():
                if kind != "ros_10":  # It would drop messages.
                    pair.throughput(max(50, count // divided))
                pair.round_trips()
        figures[name] = compared(pairs)
    figures["service_call_cpu_us"] = service(ros, others["ros"])
    print(json.dumps(figures, indent=2), flush=True)
    for each in others.values():
        each.process.kill()
    shutil.rmtree(folder, ignore_errors=True)
    os._exit(0)  # As verbs do, without waiting for the sessions to close.


if __name__ == "__main__":
    if sys.argv[1:2] == ["--other"]:
        run_other_process(*((Bare(), BARE) if sys.argv[2] == "bare" else (Ros(), tuple(PROFILES))))
    else:
        main(int(sys.argv[1]) if sys.argv[1:] else 5_000)
