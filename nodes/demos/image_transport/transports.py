"""Image transports: raw on the topic itself, or compressed on `TOPIC/compressed`, which needs OpenCV."""

from __future__ import annotations

import importlib.util
from typing import Any

from cv_bridge import CvBridge
from sensor_msgs.msg import CompressedImage, Image

RAW, COMPRESSED = "raw", "compressed"
TRANSPORTS: dict[str, type] = {RAW: Image, COMPRESSED: CompressedImage}
"""The message type of each transport."""
_BRIDGE = CvBridge()


def topic_of(base: str, transport: str) -> str:
    """Return the topic that a transport uses for the images of a base topic."""
    return base if transport == RAW else f"{base}/{transport}"


def available() -> list[str]:
    """Return the transports that are available."""
    return [RAW, COMPRESSED] if importlib.util.find_spec("cv2") else [RAW]


def encoded(image: Image, transport: str) -> Any:
    """Return an image encoded for a transport; raises `CvBridgeError` for encodings that JPEG does not support."""
    if transport == RAW:
        return image
    target = "mono8" if image.encoding.startswith("mono") else "bgr8"
    message = _BRIDGE.cv2_to_compressed_imgmsg(_BRIDGE.imgmsg_to_cv2(image, target))
    message.header = image.header
    message.format = f"{image.encoding}; jpeg compressed {target if target == 'bgr8' else ''}"
    return message


def decoded(message: Any, transport: str) -> Image:
    """Return the image decoded from a transport's message; raises `CvBridgeError` for invalid data."""
    if transport == RAW:
        return message
    pixels = _BRIDGE.compressed_imgmsg_to_cv2(message)
    image = _BRIDGE.cv2_to_imgmsg(pixels, "bgr8" if pixels.ndim == 3 else "mono8", header=message.header)
    wanted = message.format.partition(";")[0].strip() if ";" in message.format else ""
    if wanted and wanted != image.encoding:
        image = _BRIDGE.cv2_to_imgmsg(_BRIDGE.imgmsg_to_cv2(image, wanted), wanted, header=message.header)
    return image
