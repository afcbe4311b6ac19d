"""How this program's own nodes join ROS."""

from __future__ import annotations

WITHOUT_LOG_FILE = ["--ros-args", "--disable-external-lib-logs"]
"""Arguments of the contexts of our own nodes: they log nothing of interest, and a folder for log files that cannot be
written must not prevent a stop.
"""
