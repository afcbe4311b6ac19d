"""A buffer forgets its transforms when simulated time jumps back, as in the second round of a bag."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest
from frames import frame, place
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.time import Time
from rosgraph_msgs.msg import Clock
from tf2_ros import Buffer, StaticTransformBroadcaster, StaticTransformListener, TransformBroadcaster, TransformListener

Serve = Callable[[Callable[[], bool]], None]
WARNING = "[tf2_buffer]: Detected jump back in time. Clearing tf buffer."


class Rig:
    """A node in simulated time, with a buffer, and publishers of time and transforms."""

    def __init__(self, node: Node, serve: Serve, made: str = "Buffer()") -> None:
        self.node, self.serve = node, serve
        node.set_parameters([Parameter("use_sim_time", value=True)])
        self.buffer = Buffer(node=node) if made == "Buffer(node=node)" else Buffer()
        listens = StaticTransformListener if made == "StaticTransformListener" else TransformListener
        self.listener: Any = listens(self.buffer, node)
        self.clock = node.create_publisher(Clock, "/clock", 10)
        self.broadcaster = TransformBroadcaster(node)

    def set_time(self, second: float) -> None:
        self.clock.publish(Clock(clock=Time(seconds=second).to_msg()))
        self.serve(lambda: math.isclose(self.node.get_clock().now().nanoseconds, second * 1e9, abs_tol=1.0))

    def publish(self, at: float, x: float) -> None:
        self.broadcaster.sendTransform(frame("map", "base", at, x))

    def known(self, at: float) -> bool:
        return bool(self.buffer.can_transform("map", "base", Time(seconds=at)))


@pytest.mark.parametrize("made", ["Buffer()", "Buffer(node=node)"])
def test_second_round_of_a_bag_gives_the_transforms_of_its_own_time(
    node: Node, serve: Serve, made: str, capfd: pytest.CaptureFixture[str]
) -> None:
    rig = Rig(node, serve, made)
    for at in (1.0, 2.0, 50.0):
        rig.set_time(at)
        rig.publish(at, x=at)
    serve(lambda: rig.known(50.0))
    rig.set_time(0.5)
    assert not rig.known(50.0)
    rig.publish(1.0, x=-1.0)
    serve(lambda: rig.known(1.0))
    assert place(rig.buffer.lookup_transform("map", "base", Time())) == (-1.0, 0.0, 0.0)
    assert capfd.readouterr().err.count(WARNING) == 1


def test_static_transforms_outlive_a_jump(node: Node, serve: Serve) -> None:
    rig = Rig(node, serve)
    StaticTransformBroadcaster(node).sendTransform(frame("base", "laser", x=1.0))
    serve(lambda: bool(rig.buffer.can_transform("base", "laser", Time())))
    rig.set_time(5.0)
    rig.set_time(1.0)
    assert rig.buffer.can_transform("base", "laser", Time())


def test_static_listener_follows_the_clock(node: Node, serve: Serve, capfd: pytest.CaptureFixture[str]) -> None:
    rig = Rig(node, serve, "StaticTransformListener")
    rig.set_time(5.0)
    rig.buffer.set_transform(frame("map", "base", 5.0), "me")
    rig.set_time(4.999)
    assert not rig.known(5.0) and WARNING in capfd.readouterr().err


@pytest.mark.parametrize("later", [5.0, 5.1, 500.0])
def test_time_that_only_advances_keeps_the_transforms(
    node: Node, serve: Serve, later: float, capfd: pytest.CaptureFixture[str]
) -> None:
    rig = Rig(node, serve)
    rig.set_time(5.0)
    rig.buffer.set_transform(frame("map", "base", 5.0), "me")
    rig.set_time(later)
    assert rig.known(5.0) and WARNING not in capfd.readouterr().err


def test_switch_to_simulated_time_forgets_the_transforms(
    node: Node, serve: Serve, capfd: pytest.CaptureFixture[str]
) -> None:
    buffer = Buffer(node=node)
    buffer.set_transform(frame("map", "base", 5.0), "me")
    node.set_parameters([Parameter("use_sim_time", value=True)])
    assert not buffer.can_transform("map", "base", Time())
    assert "Detected time source change. Clearing tf buffer." in capfd.readouterr().err


def test_awaited_transform_arrives_after_the_jump(node: Node, serve: Serve) -> None:
    rig = Rig(node, serve)
    rig.set_time(50.0)
    future = rig.buffer.wait_for_transform_async("map", "base", Time(seconds=2.0))
    rig.set_time(1.0)
    rig.publish(2.0, x=3.0)
    serve(future.done)
    assert place(rig.buffer.lookup_transform("map", "base", Time(seconds=2.0))) == (3.0, 0.0, 0.0)


def test_program_with_a_buffer_of_its_own_class_listens_as_before(node: Node, serve: Serve) -> None:
    class Own:
        def __init__(self) -> None:
            self.got: list[str] = []

        def set_transform_static(self, transform: Any, authority: str) -> None:
            self.got.append(transform.child_frame_id)

    own: Any = Own()
    StaticTransformListener(own, node)
    StaticTransformBroadcaster(node).sendTransform(frame("base", "laser"))
    serve(lambda: own.got == ["laser"])
