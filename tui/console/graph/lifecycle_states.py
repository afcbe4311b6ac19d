"""The transitions of a lifecycle node in each state, by their labels; the same for all nodes of ROS 2."""

from __future__ import annotations

from collections.abc import Mapping

GET_STATE = "lifecycle_msgs/srv/GetState"
"""The type of the service by which lifecycle nodes are recognised."""
TRANSITIONS: Mapping[str, tuple[str, ...]] = {
    "unconfigured": ("configure", "shutdown"),
    "inactive": ("activate", "cleanup", "shutdown"),
    "active": ("deactivate", "shutdown"),
}
