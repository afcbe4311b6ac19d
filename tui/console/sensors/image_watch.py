"""Receives the newest image of one topic, and scales it on demand for a text screen."""

from __future__ import annotations

import importlib
import io
import time
from typing import Any

import numpy as np
from bot_console.tui.console.model import GraphInfo
from bot_console.tui.console.sensors import image_conversion
from bot_console.tui.console.sensors.camera_image import COMPRESSED, IMAGE, Picture
from bot_console.tui.console.topics.followed_topic import FollowedTopic
from bot_console.tui.console.topics.offered_topics import Offer
from rclpy.node import Node
from rclpy.qos import QoSProfile

MAX_IMAGE_BYTES = 50_000_000
"""Maximum size of a compressed image in bytes, and also in pixels; a larger one is not decoded."""
NO_PIL = "compressed images need Pillow: pip install 'bot-console[images]'"


class ImageWatch(FollowedTopic):
    """Keeps the newest message, and converts it to pixels only on demand."""

    def __init__(self, node: Node) -> None:
        super().__init__(node)
        self._size = (0, 0)
        self._newest: tuple[str, int, Any] = ("", 0, None)
        """The topic of the newest message, its number, and the message; one value, as two threads use it."""
        self._made: tuple[object, Picture] = (None, Picture())

    def watch_image(self, topic: str, columns: int, rows: int, graph: GraphInfo) -> None:
        """Subscribe to this topic and no other; called by the executor."""
        self._size = (columns, rows)
        if topic != self._topic:
            self._detach()
            self._topic, self._newest, self._problem = topic, (topic, 0, None), ""
        self.follow(graph)

    def _class(self, kind: str) -> type:
        if kind not in (IMAGE, COMPRESSED):
            raise ValueError(f"{self._topic} is of type {kind}, which is not an image")
        return getattr(importlib.import_module("sensor_msgs.msg"), kind.rpartition("/")[2])

    def _profile(self, offer: Offer) -> QoSProfile:
        wide = offer.profile()
        return QoSProfile(depth=1, reliability=wide.reliability, durability=wide.durability)

    def _take(self, message: Any) -> None:
        topic, count, _ = self._newest
        self._newest = (topic, count + 1, message)

    def picture(self) -> Picture:
        """The newest image, from any thread; the same object until there is another or another size is requested."""
        topic, count, message = self._newest
        key = (topic, count, self._size, self._problem)
        if self._made[0] != key:
            self._made = (key, self._picture(topic, count, message))
        return self._made[1]

    def _picture(self, topic: str, count: int, message: Any) -> Picture:
        if message is None:
            return Picture(topic, problem=self._problem)
        began = time.monotonic()
        try:
            width, height, encoding, shown, output = _convert(message, *self._size)
        except ValueError as error:
            return Picture(topic, count=count, problem=str(error))
        rows, columns = shown.shape[:2]
        return Picture(
            topic,
            count,
            width,
            height,
            encoding,
            columns,
            rows,
            shown.tobytes(),
            output,
            time.monotonic() - began,
        )


def _convert(message: Any, columns: int, rows: int) -> tuple[int, int, str, image_conversion.Pixels, str]:
    """Width, height, encoding, the scaled pixels, and a note about them; raises `ValueError`."""
    if hasattr(message, "encoding"):
        shown, output = image_conversion.scaled(message, columns, rows)
        return int(message.width), int(message.height), str(message.encoding), shown, output
    image = _decode_image(bytes(message.data))
    height, width = image.shape[:2]
    return width, height, str(message.format)[:24], image_conversion.scale_rgb(image, columns, rows), ""


def _decode_image(data: bytes) -> Any:
    """Decode a JPEG or PNG to an array of RGB; raises `ValueError`."""
    try:
        library: Any = importlib.import_module("PIL.Image")
    except ImportError:
        raise ValueError(NO_PIL) from None
    if len(data) > MAX_IMAGE_BYTES:
        raise ValueError(f"a compressed image of {len(data)} bytes is too large to be shown")
    try:
        with library.open(io.BytesIO(data)) as image:
            if image.width * image.height > MAX_IMAGE_BYTES:
                raise ValueError(f"{image.width} x {image.height} pixels are too many to be shown")
            return np.asarray(image.convert("RGB"))
    except library.UnidentifiedImageError:
        raise ValueError("this image cannot be decoded: it is in no known format") from None
    except (OSError, SyntaxError, EOFError, KeyError, library.DecompressionBombError) as error:
        raise ValueError(f"this image cannot be decoded: {error}") from None
