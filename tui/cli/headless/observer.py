"""The node of a headless run that requests the simulator's report at the end."""

from __future__ import annotations

import json
import threading
from collections import Counter
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import rclpy
from bot_console.runtime.process import current
from bot_console.tui.console.model import Endpoint, GraphInfo
from rclpy.clock import Clock, ClockType
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_srvs.srv import Trigger

if TYPE_CHECKING:
    from bot_console.tui.console.plot.watch import PlotWatch

ANSWER_TIMEOUT_S = 5.0
"""Seconds to wait for an answer if the run ends early."""
PROBE_PERIOD_S = 0.1
"""Seconds between two measurements of a timer's lateness."""
STEPPED_PROBE_PERIOD_S = 1.0
"""The same in a long stepped run, in which load delays no timer and each measurement costs a turn."""


class Observer:
    """Waits until a run of `duration` s is over, calls the service `report`, and keeps the result.

    It subscribes to `paths`, fields of topics such as `/odom/twist.twist.linear.x`, as soon as the topics exist.
    """

    def __init__(self, duration: float, paths: Sequence[str] = ()) -> None:
        self._duration = duration
        self._period = PROBE_PERIOD_S
        self._paths = paths
        self._waited_for = list(paths)
        self._topics: PlotWatch | None = None
        self._figures: dict[str, Any] = {}
        # Latenesses are counted, rounded to microseconds, so that a day takes no more memory than a minute.
        self._late: Counter[float] = Counter()
        self._collisions = 0
        self._node: Node | None = None
        self.done = threading.Event()
        self._asked = False
        self.complete = False
        """Whether the simulator has answered."""

    def run(self) -> None:
        """The main function of the observer's node process."""
        rclpy.init()
        node = rclpy.create_node(
            "_observer", enable_rosout=False, start_parameter_services=False, use_global_arguments=False
        )
        self._steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._client = node.create_client(Trigger, "/report")
        self._end = node.create_timer(self._duration, self._ask, clock=self._steady)
        self._due = self._steady.now().nanoseconds
        if current().clock.stepped and not self._paths:
            self._period = min(STEPPED_PROBE_PERIOD_S, max(PROBE_PERIOD_S, 0.1 * self._duration))
        node.create_timer(self._period, self._probe, clock=self._steady)
        self._now = node.create_guard_condition(self._ask)
        if self._paths:
            from bot_console.tui.console.plot.watch import PlotWatch

            self._topics = PlotWatch(node)
        self._node = node
        try:
            rclpy.spin(node)
        except (KeyboardInterrupt, ExternalShutdownException):
            pass
        finally:
            node.destroy_node()
            rclpy.try_shutdown()

    def finish_early(self) -> None:
        """Request the report now, and wait at most `ANSWER_TIMEOUT_S` for it; may be called from any thread."""
        if self._node is not None:
            self._now.trigger()
            self.done.wait(ANSWER_TIMEOUT_S)

    def _probe(self) -> None:
        period = round(self._period * 1e9)
        now = self._steady.now().nanoseconds
        self._due += period
        late = now - self._due
        self._late[round(late * 1e-6, 3) if late else 0.0] += 1
        if late > 0:
            self._due += late // period * period
        if self._waited_for and self._node is not None and self._topics is not None:
            self._listen(self._node, self._topics)

    def _listen(self, node: Node, topics: PlotWatch) -> None:
        found = node.get_topic_names_and_types()
        graph = GraphInfo(topics=tuple(Endpoint(name, tuple(types)) for name, types in found))
        self._waited_for = [each for each in self._waited_for if not topics.watch(each, graph, {}).ok]

    def _ask(self) -> None:
        if self._asked:
            return
        if not self._client.service_is_ready():
            self._end.timer_period_ns = round(PROBE_PERIOD_S * 1e9)  # there is no simulator, or it is still starting
            return
        self._asked = True
        self._end.cancel()
        self._client.call_async(Trigger.Request()).add_done_callback(self._answered)

    def _answered(self, future: Any) -> None:
        self._figures = json.loads(future.result().message)
        self.complete = True
        self._figures["messages"] = self._node.context.bus.published() if self._node else 0
        self.done.set()

    def report(self) -> dict[str, Any]:
        """The figures that are known so far; times in s, lateness in ms."""
        late = sorted(self._late.elements())
        if late:
            self._figures["timer_lateness_ms"] = {
                "median": late[len(late) // 2],
                "p99": late[min(len(late) - 1, len(late) * 99 // 100)],
                "max": late[-1],
            }
        if self._topics is not None:
            from bot_console.tui.tuning.score import statistics

            self._figures["topics"] = {
                path: statistics([float(each) for each in self._topics.samples(path, 0).values]) for path in self._paths
            }
        return self._figures
