"""An image of a camera as the panes show it. Standard library only."""

from __future__ import annotations

from dataclasses import dataclass

IMAGE, COMPRESSED = "sensor_msgs/msg/Image", "sensor_msgs/msg/CompressedImage"
"""The types that can be viewed."""


@dataclass(frozen=True, slots=True)
class Picture:
    """The newest image of the topic being viewed, scaled to the size asked for."""

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
    """Red, green and blue of each pixel shown, row by row."""
    message: str = ""
    """The meaning of black and white, if they are not colours."""
    seconds: float = 0.0
    """How long scaling took."""
    problem: str = ""
    """Why there is none; empty when all is well."""
