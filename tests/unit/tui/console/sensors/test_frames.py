"""Published frames, and the faults found in them."""

from __future__ import annotations

import math
import sys
from types import SimpleNamespace
from typing import Any

import pytest
from bot_console.tui.console.model import Endpoint, GraphInfo, NodeInfo
from bot_console.tui.console.sensors.frames import Frame, Frames, findings
from bot_console.tui.console.sensors.frames_watch import FramesWatch
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage

TF = "tf2_msgs/msg/TFMessage"
GRAPH = GraphInfo(
    nodes=(
        NodeInfo("/base", publishers=(Endpoint("/tf", (TF,), "reliable volatile 100"),)),
        NodeInfo("/arm", publishers=(Endpoint("/tf_static", (TF,), "reliable transient local 1"),)),
    )
)


class Bench:
    """A watch over a node that only counts subscriptions, and a clock."""

    def __init__(self) -> None:
        self.now = 100.0
        self.topics: list[str] = []
        node: Any = SimpleNamespace(create_subscription=self._subscribe, destroy_subscription=self.topics.remove)
        self.watch = FramesWatch(node, lambda: self.now)

    def _subscribe(self, kind: type, topic: str, callback: Any, profile: Any) -> str:
        self.topics.append(topic)
        return topic

    def reported(
        self, parent: str, child: str, x: float = 0.0, yaw: float = 0.0, *, fixed: bool = False, at: float = 0.0
    ) -> None:
        message = TransformStamped(child_frame_id=child)
        message.header.stamp.sec, message.header.stamp.nanosec = int(at), int(at % 1 * 1e9)
        message.header.frame_id = parent
        message.transform.translation.x = x
        message.transform.rotation.z, message.transform.rotation.w = math.sin(yaw / 2), math.cos(yaw / 2)
        take = self.watch.take_fixed if fixed else self.watch.take_moving
        take(TFMessage(transforms=[message]))

    def frame(self, name: str) -> Frame:
        return next(each for each in self.watch.frames().frames if each.name == name)


def test_a_missing_tf2_msgs_package_is_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "tf2_msgs.msg", None)
    bench = Bench()
    bench.watch.poll(True, GRAPH)
    assert bench.topics == []
    assert bench.watch.frames().problem.startswith("the type tf2_msgs/msg/TFMessage is not available here")


def test_nothing_is_subscribed_while_nobody_is_viewing() -> None:
    bench = Bench()
    bench.watch.follow(GRAPH)
    assert bench.topics == []
    bench.watch.poll(True, GRAPH)
    assert bench.topics == ["/tf", "/tf_static"]
    bench.reported("map", "odom")
    bench.watch.follow(GraphInfo(nodes=GRAPH.nodes[1:]))
    assert bench.topics == ["/tf_static"]
    assert (bench.watch.frames().moving_by, bench.watch.frames().fixed_by) == ((), ("/arm",))
    bench.watch.poll(False, GRAPH)
    assert bench.topics == [] and bench.watch.frames().frames == ()


def test_rate_position_and_age_are_measured() -> None:
    bench = Bench()
    for _ in range(40):
        bench.reported("map", "/odom", 1.5, 0.5)
        bench.now += 0.1
    frame = bench.frame("odom")
    assert (frame.parent, frame.place[0], frame.fixed) == ("map", 1.5, False)
    assert frame.turn == pytest.approx((0.0, 0.0, 0.5))
    assert frame.rate == pytest.approx(10.0)
    assert frame.late is None  # its stamp is from another clock
    assert bench.now - frame.last_received == pytest.approx(0.1)


def test_two_parents_within_a_few_seconds_are_reported() -> None:
    bench = Bench()
    bench.reported("map", "base")
    bench.now += 1.0
    bench.reported("odom", "base")
    assert bench.frame("base").others == ("map",)
    bench.now += 10.0
    bench.reported("odom", "base")
    assert bench.frame("base").others == ()


def test_two_static_parents_stay_reported() -> None:
    bench = Bench()
    bench.reported("base", "laser", fixed=True)
    bench.reported("mast", "laser", fixed=True)
    bench.now += 60.0
    assert bench.frame("laser").others == ("base",)
    assert next(text for _, text in findings(bench.watch.frames(), bench.now)) == (
        "laser has more than one parent: base and mast; the last one received counts"
    )


def test_findings_are_described_in_text() -> None:
    frames = (
        Frame("a", "b", last_received=10.0),
        Frame("b", "a", last_received=10.0),
        Frame("base", "odom", last_received=10.0, others=("map",)),
        Frame("camera", "base", fixed=True, last_received=1.0),
        Frame("odom", "world", last_received=5.0),
        Frame("slow", "map", last_received=8.0, rate=1.0),
    )
    assert [text for _, text in findings(Frames(frames), 10.0)] == [
        "a in b in a: a loop, so nothing can be looked up in it",
        "base has more than one parent: map and odom; it jumps from one to the other",
        "odom was last published 5 s ago",
        "2 separate trees: map, world",
    ]
    assert list(findings(Frames(frames[3:4]), 10.0)) == []


def test_frames_from_before_a_jump_back_in_time_are_forgotten() -> None:
    bench = Bench()
    bench.watch.poll(True, GRAPH)
    bench.reported("base", "laser", fixed=True, at=50.0)
    bench.reported("old_parent", "base", at=50.0)
    bench.reported("base", "gripper", at=50.0)
    bench.reported("odom", "base", at=50.0)
    bench.reported("odom", "base", x=1.0, at=0.5)
    assert [each.name for each in bench.watch.frames().frames] == ["base", "laser"]
    assert bench.frame("base").parent == "odom" and bench.frame("base").others == ()


@pytest.mark.parametrize("back_s", [0.0, 0.3, 1.0])
def test_late_transforms_do_not_count_as_a_jump_back_in_time(back_s: float) -> None:
    bench = Bench()
    bench.watch.poll(True, GRAPH)
    bench.reported("base", "gripper", at=50.0)
    bench.reported("odom", "base", at=50.0)
    bench.reported("odom", "base", at=50.0 - back_s)
    assert [each.name for each in bench.watch.frames().frames] == ["base", "gripper"]


def test_two_publishers_with_two_clocks_do_not_count_as_a_jump_back_in_time() -> None:
    bench = Bench()
    bench.watch.poll(True, GRAPH)
    for second in range(3):
        bench.reported("odom", "base", at=1000.0 + second)
        bench.reported("map", "base", at=2.0 + second)
    assert bench.frame("base").others == ("odom",)
