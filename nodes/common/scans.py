"""Converts LaserScan messages to NumPy arrays and back, without a loop over the beams."""

from __future__ import annotations

from array import array
from typing import TypeAlias

import numpy as np
import numpy.typing as npt
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import LaserScan

Floats: TypeAlias = "npt.NDArray[np.float32]"
SCANS = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
"""QoS for subscribing to scans: drivers of real LIDARs offer best effort, which a reliable subscription never
receives.
"""


def ranges_of(scan: LaserScan) -> Floats:
    """Return the ranges in m as a view, which must not be modified."""
    return np.frombuffer(memoryview(scan.ranges), np.float32)


def intensities_of(scan: LaserScan) -> Floats:
    """Return the intensities, empty if the sensor provides none, as a view, which must not be modified."""
    return np.frombuffer(memoryview(scan.intensities), np.float32)


def nearest_return(scan: LaserScan) -> float:
    """Return the distance in m to the nearest return, or the sensor's maximum range if there is none."""
    ranges = ranges_of(scan)
    valid = ranges[(ranges > scan.range_min) & (ranges <= scan.range_max)]
    return float(valid.min()) if len(valid) else float(scan.range_max)


def packed(values: npt.NDArray[np.float64] | Floats) -> array[float]:
    """Numbers as the float32 array of a message field."""
    result = array("f")
    result.frombytes(values.astype(np.float32).tobytes())
    return result
