"""Makes a workspace's packages importable before any ROS package is; then runs the `sitecustomize` it hides."""

import sys

if sys.version_info[0] > 2:
    __import__("bot_console_shims").watch()
    __import__("bot_console_shims").run_hidden(__name__)
