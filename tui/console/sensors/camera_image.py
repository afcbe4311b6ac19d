"""A camera image as the panes see it. Standard library only."""

from __future__ import annotations

from dataclasses import dataclass

IMAGE, COMPRESSED = "sensor_msgs/msg/Image", "sensor_msgs/msg/CompressedImage"
"""The message types that can be viewed."""


@dataclass(frozen=True, slots=True)
class Picture:
    """The newest image of the topic being viewed, scaled to the requested size."""

    topic: str = ""
    count: int = 0
    """Number of images received so far."""
    width: int = 0
    height: int = 0
    """Height of the original image, in pixels."""
    encoding: str = ""
    columns: int = 0
    rows: int = 0
    pixels: bytes = b""
    """Red, green and blue of each displayed pixel, row by row."""
    message: str = ""
    """The values that black and white stand for, if they are not colours."""
    seconds: float = 0.0
    """How long scaling took, in seconds."""
    problem: str = ""
    """Why there is no image; empty when all is well."""
