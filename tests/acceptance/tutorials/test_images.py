"""Images republished by another transport, for programs that subscribe to `camera/image_raw/compressed`."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from types import ModuleType

import numpy as np
import pytest
from systems import Program, System, system

IMAGE = "sensor_msgs/msg/Image"
PIXEL = "{header: {frame_id: eye}, height: 1, width: 1, encoding: rgb8, step: 3, data: [1, 2, 3]}"


@pytest.fixture
def running() -> Iterator[System]:
    with system() as found:
        yield found


@pytest.fixture
def codec(monkeypatch: pytest.MonkeyPatch) -> None:
    """A stand-in for OpenCV: its JPEG consists of the bytes of one row of pixels."""
    fake = ModuleType("cv2")
    fake.__spec__ = sys.__spec__
    fake.IMREAD_UNCHANGED = -1  # type: ignore[attr-defined] -- a stand-in for a module
    fake.imencode = lambda suffix, image: (True, image.reshape(-1))  # type: ignore[attr-defined] -- the same
    fake.imdecode = lambda data, flags: data.reshape(1, -1, 3).astype(np.uint8)  # type: ignore[attr-defined] -- the same
    monkeypatch.setitem(sys.modules, "cv2", fake)


def republish(running: System, *words: str) -> Program:
    program = running.executable("image_transport", "republish", *words)
    running.run(0.5)
    return program


def test_images_are_compressed_while_subscribed(running: System, codec: None) -> None:
    republish(running, "raw", "compressed", "--ros-args", "-r", "in:=camera", "-r", "out/compressed:=camera/compressed")
    running.ros2("topic", "pub", "-r", "5", "/camera", IMAGE, PIXEL)
    running.run(1.0)
    assert "Subscription count: 0" in running.ask("topic", "info", "/camera").stdout
    reported = running.ask("topic", "echo", "--once", "/camera/compressed").stdout
    assert "frame_id: eye" in reported and "format: rgb8; jpeg compressed bgr8" in reported
    assert reported.endswith("data:\n- 3\n- 2\n- 1\n---\n")
    running.run(1.0)
    assert "Subscription count: 0" in running.ask("topic", "info", "/camera").stdout


def test_compressed_images_are_decoded_to_their_encoding(running: System, codec: None) -> None:
    republish(running, "compressed", "raw")
    fields = "{format: 'rgb8; jpeg compressed bgr8', data: [3, 2, 1]}"
    running.ros2("topic", "pub", "-r", "5", "/in/compressed", "sensor_msgs/msg/CompressedImage", fields)
    reported = running.ask("topic", "echo", "--once", "/out").stdout
    assert "encoding: rgb8" in reported and reported.endswith("data:\n- 1\n- 2\n- 3\n---\n")


def test_missing_opencv_is_reported_with_install_hint(running: System, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("bot_console_demos.image_transport.republish.available", lambda: ["raw"])
    refused = running.finish(running.executable("image_transport", "republish", "compressed", "raw"))
    assert refused.exit == 1
    assert "no transport 'compressed': it needs OpenCV: pip install 'bot-console[opencv]'" in refused.stderr
    unknown = running.finish(running.executable("image_transport", "republish", "theora"))
    assert "no transport 'theora': available transports: raw, compressed" in unknown.stderr
    assert running.finish(running.executable("image_transport", "republish", "--help")).exit == 1


def test_raw_images_are_republished_by_parameters(running: System) -> None:
    republish(running, "--ros-args", "-p", "in_transport:=raw", "-p", "out_transport:=raw")
    running.ros2("topic", "pub", "-r", "5", "/in", IMAGE, PIXEL)
    assert "encoding: rgb8" in running.ask("topic", "echo", "--once", "/out").stdout
