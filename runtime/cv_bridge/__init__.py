"""ROS images as NumPy arrays, as in upstream's `cv_bridge`; OpenCV only for compressed images and Bayer patterns."""

from cv_bridge.conversion import cvtColor2
from cv_bridge.core import CvBridge, CvBridgeError
from cv_bridge.encodings import getCvType

__all__ = ["CvBridge", "CvBridgeError", "cvtColor2", "getCvType"]
