"""The cost of the rclpy core: `python tests/benchmarks/bench_rclpy.py [RUNS]`, JSON out.

Each run is a separate process; medians and spread are over the runs. CPU time, except for latencies. `floor` is the
same work in plain Python (copy the object, append it to a deque, notify a condition, call); `ratio` is to the floor of
the same run.
"""

from __future__ import annotations

import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections import deque
from collections.abc import Callable
from threading import Condition, Event, Thread
from typing import Any

MESSAGES = 20_000
MICRO = 1e6
NODES = 100
IDLE = 200

BARS = {
    "float64_us": 4,
    "twist_us": 5,
    "laserscan_us": 6,
    "nodes_2_us": 4,
    "nodes_50_over_2": 1.3,
    "latency_p50_us": 20,
    "timer_us": 4,
    "set_parameters_us": 12,
    "service_call_us": 60,
    "logger_us": 7,
    "create_100_nodes_ms": 60,
    "destroy_100_nodes_ms": 30,
    "memory_per_node_kb": 40,
    "start_ms": 120,
}

START = """
from bot_console.runtime.importer import install
install()
import rclpy
from std_msgs.msg import Float64
from geometry_msgs.msg import Twist
from sensor_msgs.msg import LaserScan
rclpy.init()
node = rclpy.create_node("start")
got = []
node.create_subscription(Float64, "t", got.append, 10)
node.create_publisher(Float64, "t", 10).publish(Float64())
while not got:
    rclpy.spin_once(node)
"""


def messages() -> dict[str, Any]:
    """The messages of the table; the scan has 360 ranges and 360 intensities."""
    from geometry_msgs.msg import Twist
    from sensor_msgs.msg import LaserScan
    from std_msgs.msg import Float64

    scan = LaserScan()
    scan.ranges = [1.0] * 360
    scan.intensities = [2.0] * 360
    return {"float64": Float64(data=1.0), "twist": Twist(), "laserscan": scan}


def floor_of(message: Any) -> float:
    """Microseconds to copy, queue, notify and call without any ROS."""
    queue: deque[Any] = deque(maxlen=10)
    condition = Condition()
    seen = [0]

    def callback(_: Any) -> None:
        seen[0] += 1

    start = time.process_time()
    for _ in range(MESSAGES):
        queue.append(message._copy_())
        with condition:
            condition.notify()
        callback(queue.popleft())
    return (time.process_time() - start) / MESSAGES * MICRO


def in_flight(nodes: int, message: Any, *, spin_once: bool = False, threads: int = 0) -> float:
    """Microseconds per message, one in flight: each callback publishes the next one."""
    import rclpy
    from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor

    rclpy.init(args=[])
    executor = MultiThreadedExecutor(threads) if threads else SingleThreadedExecutor()
    made = [rclpy.create_node(f"n{number}") for number in range(nodes)]
    for node in made:
        node.create_publisher(type(message), "idle", 10)
        node.create_subscription(type(message), "quiet", lambda message: None, 10)
        node.create_timer(3600.0, lambda: None)
        executor.add_node(node)
    publisher = made[0].create_publisher(type(message), "ping", 10)
    left = [MESSAGES]

    def again(_: Any) -> None:
        left[0] -= 1
        if left[0] > 0:
            publisher.publish(message)
        else:
            executor.shutdown()

    made[-1].create_subscription(type(message), "ping", again, 10)
    publisher.publish(message)
    start = time.process_time()
    if spin_once:
        while left[0] > 0:
            executor.spin_once()
    else:
        executor.spin()
    spent = time.process_time() - start
    end(*made)
    return spent / MESSAGES * MICRO


def end(*nodes: Any) -> None:
    """Clean up, so that no measurement affects the next one."""
    import rclpy

    for node in nodes:
        node.destroy_node()
    rclpy.shutdown()


def latency() -> tuple[float, float]:
    """Median and 99th percentile of the wall time from publish to callback, in microseconds."""
    import rclpy
    from std_msgs.msg import Float64

    rclpy.init(args=[])
    sender, receiver = rclpy.create_node("sender"), rclpy.create_node("receiver")
    executor = rclpy.executors.SingleThreadedExecutor()
    executor.add_node(sender)
    executor.add_node(receiver)
    taken: list[int] = []
    receiver.create_subscription(Float64, "ping", lambda _: taken.append(time.perf_counter_ns() - sent), 10)
    publisher = sender.create_publisher(Float64, "ping", 10)
    message = Float64()
    for _ in range(5_000):
        sent = time.perf_counter_ns()
        publisher.publish(message)
        executor.spin_once()
    end(sender, receiver)
    taken.sort()
    return taken[len(taken) // 2] / 1000, taken[len(taken) * 99 // 100] / 1000


def latency_between_threads() -> tuple[float, float]:
    """The same with the executor in a separate thread, which the publisher's thread has to wake."""
    import rclpy
    from std_msgs.msg import Float64

    rclpy.init(args=[])
    sender, receiver = rclpy.create_node("sender"), rclpy.create_node("receiver")
    executor = rclpy.executors.SingleThreadedExecutor()
    executor.add_node(receiver)
    taken: list[int] = []
    arrived = Event()

    def callback(_: Any) -> None:
        taken.append(time.perf_counter_ns() - sent)
        arrived.set()

    receiver.create_subscription(Float64, "ping", callback, 10)
    publisher = sender.create_publisher(Float64, "ping", 10)
    message, spinning = Float64(), Thread(target=executor.spin, daemon=True)
    spinning.start()
    for _ in range(5_000):
        arrived.clear()
        sent = time.perf_counter_ns()
        publisher.publish(message)
        arrived.wait(5.0)
    executor.shutdown()
    spinning.join(5.0)
    end(sender, receiver)
    taken.sort()
    return taken[len(taken) // 2] / 1000, taken[len(taken) * 99 // 100] / 1000


def per_call(action: Callable[[], Any], count: int) -> float:
    """Microseconds of CPU time per call."""
    start = time.process_time()
    for _ in range(count):
        action()
    return (time.process_time() - start) / count * MICRO


def timer() -> float:
    """Microseconds per callback of a timer of 1 us, which is always late."""
    import rclpy

    rclpy.init(args=[])
    node = rclpy.create_node("timed")
    executor = rclpy.executors.SingleThreadedExecutor()
    executor.add_node(node)
    left = [MESSAGES]

    def tick() -> None:
        left[0] -= 1
        if not left[0]:
            executor.shutdown()

    node.create_timer(1e-6, tick)
    start = time.process_time()
    executor.spin()
    spent = time.process_time() - start
    end(node)
    return spent / MESSAGES * MICRO


def parameters() -> tuple[float, float]:
    """Microseconds of a local `set_parameters` with a validating callback, and of a SetParameters call."""
    import rclpy
    from rcl_interfaces.msg import SetParametersResult
    from rcl_interfaces.srv import SetParameters

    rclpy.init(args=[])
    node, other = rclpy.create_node("tuned"), rclpy.create_node("tuner")
    node.declare_parameter("speed", 1.0)

    def validate(changes: list[Any]) -> Any:
        good = all(change.name != "speed" or 0.1 <= change.value <= 5.0 for change in changes)
        return SetParametersResult(successful=good)

    node.add_on_set_parameters_callback(validate)
    change = [rclpy.Parameter("speed", value=2.0)]
    local = per_call(lambda: node.set_parameters(change), 5_000)
    executor = rclpy.executors.SingleThreadedExecutor()
    executor.add_node(node)
    executor.add_node(other)
    client = other.create_client(SetParameters, "/tuned/set_parameters")
    request = SetParameters.Request(parameters=[change[0].to_parameter_msg()])

    def call() -> None:
        future = client.call_async(request)
        while not future.done():
            executor.spin_once()

    remote = per_call(call, 3_000)
    end(node, other)
    return local, remote


def logger() -> float:
    """Microseconds of `info` with `/rosout` on and the console to the null device."""
    import rclpy

    rclpy.init(args=[])
    node = rclpy.create_node("talkative")
    log = node.get_logger()
    console, sys.stderr = sys.stderr, open(os.devnull, "w")  # noqa: SIM115
    try:
        return per_call(lambda: log.info("the robot is at 1.0, 2.0"), 10_000)
    finally:
        sys.stderr = console
        end(node)


def many_nodes() -> tuple[float, float, float]:
    """Milliseconds to make and to destroy 100 nodes, and kilobytes of memory per idle node."""
    import rclpy

    rclpy.init(args=[])
    rclpy.create_node("first")
    before = resident_kb()
    idle = [rclpy.create_node(f"idle{number}") for number in range(IDLE)]
    memory = (resident_kb() - before) / len(idle)
    start = time.process_time()
    nodes = [rclpy.create_node(f"node{number}") for number in range(NODES)]
    made = time.process_time()
    for node in nodes:
        node.destroy_node()
    gone = time.process_time()
    end(*idle)
    return (made - start) * 1000, (gone - made) * 1000, memory


def resident_kb() -> float:
    """Resident memory in kilobytes, after garbage collection."""
    import gc

    gc.collect()
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * resource.getpagesize() / 1000


def start_up() -> float:
    """Milliseconds from the interpreter's start to the first message, in a new process that finds its byte code."""
    with tempfile.TemporaryDirectory() as cache:
        environment = {**os.environ, "PYTHONPYCACHEPREFIX": cache}
        environment.pop("PYTHONDONTWRITEBYTECODE", None)
        command = [sys.executable, "-c", START]
        subprocess.run(command, check=True, env=environment)
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run(command, check=True, env=environment)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return (after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime) * 1000


def one_run() -> dict[str, float]:
    """Every figure once, and the floor beside it."""
    figures: dict[str, float] = {"start_ms": start_up()}
    from bot_console.runtime.importer import install

    install()
    import rclpy.executors  # noqa: F401

    creation = many_nodes()
    figures["create_100_nodes_ms"], figures["destroy_100_nodes_ms"], figures["memory_per_node_kb"] = creation
    for name, message in messages().items():
        figures[f"{name}_floor_us"] = floor = floor_of(message)
        figures[f"{name}_us"] = cost = in_flight(1, message)
        figures[f"{name}_ratio"] = cost / floor
    message = messages()["float64"]
    figures["float64_spin_once_us"] = in_flight(1, message, spin_once=True)
    figures["multi_threaded_2_us"] = in_flight(2, message, threads=4)
    for nodes in (2, 10, 25, 50):
        figures[f"nodes_{nodes}_us"] = in_flight(nodes, message)
    figures["nodes_50_over_2"] = figures["nodes_50_us"] / figures["nodes_2_us"]
    figures["latency_p50_us"], figures["latency_p99_us"] = latency()
    figures["latency_threads_p50_us"], figures["latency_threads_p99_us"] = latency_between_threads()
    figures["timer_us"] = timer()
    figures["set_parameters_us"], figures["service_call_us"] = parameters()
    figures["logger_us"] = logger()
    return figures


def main(runs: int) -> None:
    """Run, and print medians, spread and goals."""
    command = [sys.executable, __file__, "--one"]
    results = [json.loads(subprocess.run(command, check=True, capture_output=True).stdout) for _ in range(runs)]
    table: dict[str, dict[str, Any]] = {}
    for name in results[0]:
        values = [result[name] for result in results]
        row: dict[str, Any] = {"median": round(statistics.median(values), 2)}
        row["spread"] = [round(min(values), 2), round(max(values), 2)]
        if name in BARS:
            row["bar"] = BARS[name]
            row["met"] = row["median"] <= BARS[name]
        table[name] = row
    print(json.dumps({"runs": runs, "python": sys.version.split()[0], "figures": table}, indent=1))


if __name__ == "__main__":
    if sys.argv[1:] == ["--one"]:
        print(json.dumps(one_run()))
    else:
        main(int(sys.argv[1]) if len(sys.argv) > 1 else 5)
