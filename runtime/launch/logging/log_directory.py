"""The location of log files: `$ROS_LOG_DIR`, else `$ROS_HOME/log`, else `~/.ros/log`, with one folder per run."""

from __future__ import annotations

import datetime
import os
import socket
import sys
import tempfile

from bot_console.runtime.process.scratch import scratch


def get_logging_directory() -> str:
    """Return the folder that holds the folders of all runs."""
    given = os.environ.get("ROS_LOG_DIR")
    if given:
        return os.path.expanduser(given)
    home = os.environ.get("ROS_HOME") or os.path.join("~", ".ros")
    return os.path.join(os.path.expanduser(home), "log")


def new_run_directory() -> str:
    """Create a unique folder for this run and point the link `latest` at it.

    If that fails, use a temporary folder and report that on stderr.
    """
    base = get_logging_directory()
    try:
        return _make_directory(base)
    except OSError as error:
        print(
            f"[WARN] [launch]: log files are not kept: {base} cannot be written ({error.strerror}); "
            "ROS_LOG_DIR names another folder",
            file=sys.stderr,
        )
    return tempfile.mkdtemp(prefix="ros-log-", dir=scratch())


def _make_directory(base: str) -> str:
    moment = datetime.datetime.now().strftime("%Y-%m-%d-%H-%M-%S-%f")
    name = f"{moment}-{socket.gethostname()}-{os.getpid()}"
    path = os.path.join(base, name)
    number = 1
    while os.path.exists(path):
        number += 1
        path = os.path.join(base, f"{name}-{number}")
    os.makedirs(path)
    _point_latest_at(base, path)
    return path


def _point_latest_at(base: str, path: str) -> None:
    link = os.path.join(base, "latest")
    try:
        if os.path.islink(link):
            os.unlink(link)
        if not os.path.exists(link):
            os.symlink(path, link, target_is_directory=True)
    except OSError:  # links are unsupported, or another run created it first; the link is only a convenience
        return
