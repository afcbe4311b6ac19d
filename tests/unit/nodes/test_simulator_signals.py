"""What programs for other robots expect is published only while somebody subscribes to it."""

from __future__ import annotations

from typing import Any

import pytest
from bot_console_robot.simulation.frame_origins import Frames
from bot_console_robot.simulation.simulation import Simulation
from bot_console_robot.simulation.world_file import parse_world
from bot_console_robot.simulation_ros.messages import time_of
from bot_console_robot.simulation_ros.models import MODELS
from bot_console_robot.simulation_ros.signals import Signals


class Recorder:
    """A publisher that keeps what is published; `listeners` is its number of subscriptions."""

    def __init__(self) -> None:
        self.listeners = 0
        self.sent: list[Any] = []
        self.publish = self.sent.append

    def get_subscription_count(self) -> int:
        return self.listeners


class Graph:
    """The part of a node that is used here: its publishers, by topic."""

    def __init__(self) -> None:
        self.topics: dict[str, Recorder] = {}

    def create_publisher(self, kind: type, topic: str, qos: Any) -> Recorder:
        return self.topics.setdefault(topic, Recorder())


@pytest.mark.parametrize("topic", ["/tf", "joint_states", "imu", "battery_state"])
def test_signals_are_published_only_while_subscribed(topic: str) -> None:
    graph: Any = Graph()
    signals = Signals(graph, MODELS["plain"])
    simulation = Simulation(parse_world("w", {"size": [4, 4], "start": [2, 2, 0]}), 1)
    signals.begin(simulation, Frames(), time_of(0))
    publisher = graph.topics[topic]

    def second() -> int:
        before = len(publisher.sent)
        for _ in range(20):
            signals.publish(simulation, time_of(simulation.time_ns))
        return len(publisher.sent) - before

    assert second() == 0
    publisher.listeners = 1
    assert second() == (1 if topic == "battery_state" else 20)
    publisher.listeners = 0
    assert second() == 0
    assert all(not other.sent for name, other in graph.topics.items() if name not in (topic, "/tf_static"))
