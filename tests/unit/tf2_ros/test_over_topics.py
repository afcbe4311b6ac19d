"""Broadcasters, the listener, and waiting for a transform."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from frames import frame, place
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.time import Time
from tf2_msgs.srv import FrameGraph
from tf2_ros import (
    Buffer,
    LookupException,
    StaticTransformBroadcaster,
    StaticTransformListener,
    TransformBroadcaster,
    TransformListener,
)

Serve = Callable[[Callable[[], bool]], None]


def test_listener_receives_broadcast_transforms(node: Node, serve: Serve) -> None:
    static = StaticTransformBroadcaster(node)
    static.sendTransform(frame("base", "laser", x=1.0))
    static.sendTransform([frame("base", "camera", x=2.0), frame("base", "laser", x=0.5)])
    buffer = Buffer()
    listener = TransformListener(buffer, node)
    TransformBroadcaster(node).sendTransform([frame("map", "base", 1.0, 1.0), frame("map", "other", 1.0)])
    serve(lambda: buffer.can_transform("map", "laser", Time()) and buffer.can_transform("map", "camera", Time()))
    assert place(buffer.lookup_transform("map", "laser", Time())) == (1.5, 0.0, 0.0)
    listener.unregister()


def test_static_listener_receives_static_transforms_only(node: Node, serve: Serve) -> None:
    buffer = Buffer()
    listener = StaticTransformListener(buffer, node)
    TransformBroadcaster(node).sendTransform(frame("map", "base", 1.0))
    StaticTransformBroadcaster(node).sendTransform(frame("base", "laser", x=1.0))
    serve(lambda: buffer.can_transform("base", "laser", Time()))
    assert not buffer.can_transform("map", "base", Time())
    listener.unregister()


def test_buffer_copies_messages() -> None:
    buffer = Buffer()
    message = frame("map", "base", 1.0, 1.0)
    buffer.set_transform(message, "me")
    message.transform.translation.x = 9.0
    assert place(buffer.lookup_transform("map", "base", Time())) == (1.0, 0.0, 0.0)


def test_numbers_of_numpy_become_ordinary_ones() -> None:
    buffer = Buffer()
    buffer.set_transform_static(frame("base", "laser", x=np.float64(2.0)), "me")
    assert type(buffer.lookup_transform("laser", "base", Time()).transform.translation.x) is float


@pytest.mark.parametrize("kind", [TransformBroadcaster, StaticTransformBroadcaster])
def test_wrong_field_names_the_line_that_broadcasts(
    node: Node, kind: type[TransformBroadcaster], capfd: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(TypeError, match=r"translation\.x"):
        kind(node).sendTransform(frame("map", "base", x=1))
    assert f", at {__file__}:" in capfd.readouterr().err


def test_future_is_done_when_the_transform_arrives(node: Node, serve: Serve) -> None:
    buffer = Buffer()
    future = buffer.wait_for_transform_async("map", "base", Time(seconds=2))
    buffer.set_transform(frame("map", "base", 1.0), "me")
    assert not future.done()
    buffer.set_transform(frame("map", "base", 3.0), "me")
    assert future.done() and place(future.result()) == place(buffer.lookup_transform("map", "base", Time(seconds=2)))
    assert buffer.wait_for_transform_async("map", "base", Time()).done()
    buffer.set_transform(frame("map", "base", 4.0), "me")
    assert buffer._new_data_callbacks == []


def test_coroutine_gets_the_transform(node: Node, serve: Serve) -> None:
    buffer = Buffer(node=node)
    TransformListener(buffer, node)
    found: list[Any] = []

    async def ask() -> None:
        found.append(await buffer.lookup_transform_async("map", "base", Time()))

    broadcaster = TransformBroadcaster(node)
    asked = node.create_timer(0.001, ask)
    serve(lambda: bool(buffer._new_data_callbacks))
    asked.cancel()
    broadcaster.sendTransform(frame("map", "base", 1.0, 4.0))
    serve(lambda: bool(found))
    assert place(found[0]) == (4.0, 0.0, 0.0)


def test_lookup_waits_until_its_timeout() -> None:
    buffer = Buffer()
    with pytest.raises(LookupException):
        buffer.lookup_transform("map", "base", Time(), timeout=Duration(seconds=0.03))
    timer = threading.Timer(0.05, lambda: buffer.set_transform(frame("map", "base", 1.0, 3.0), "me"))
    timer.start()
    assert place(buffer.lookup_transform("map", "base", Time(), timeout=Duration(seconds=20))) == (3.0, 0.0, 0.0)
    assert buffer.can_transform("map", "moon", Time(), return_debug_tuple=True)[1].startswith('Invalid frame ID "moon"')
    with pytest.raises(TypeError):
        buffer.lookup_transform("map", "moon", Time(), timeout=1.0)  # type: ignore[arg-type] -- a usual mistake


def test_tf2_frames_service_returns_the_tree(node: Node, serve: Serve) -> None:
    buffer = Buffer(node=node)
    buffer.set_transform(frame("map", "base", 1.0), "me")
    future = node.create_client(FrameGraph, "tf2_frames").call_async(FrameGraph.Request())
    serve(future.done)
    assert "base: \n  parent: 'map'" in future.result().frame_yaml
