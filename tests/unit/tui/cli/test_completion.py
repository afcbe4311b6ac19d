"""Completion of names in a running system, queried over a real domain of another process."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from processes.two_processes import two_processes

if os.name == "nt":
    pytest.skip("programs meet on Unix sockets", allow_module_level=True)


def complete(*words: str) -> list[str]:
    line = [sys.executable, "-m", "bot_console.tui", "complete", "bot-console", *words]
    return subprocess.run(line, capture_output=True, text=True, timeout=240, check=True).stdout.split()


def test_running_nodes_topics_services_and_parameters_are_completed(socket_folder: str) -> None:
    with two_processes(Path(socket_folder)) as (here, _):
        name = here.node.get_node_names()
        assert "here" in name and len(name) == 2
        assert "/here" in complete("node", "info", "/")
        assert "/here" in complete("param", "get", "")
        assert "/echo" in complete("topic", "echo", "/ec") and "/echo" in complete("rqt_plot", "/e")
        assert "/here/list_parameters" in complete("ros2", "service", "call", "/here/l")
        assert "/here" in complete("rqt_reconfigure", "")
        assert complete("service", "call", "/here/list_parameters", "") == ["rcl_interfaces/srv/ListParameters"]
        assert complete("topic", "pub", "/rosout", "") == ["rcl_interfaces/msg/Log"]
        assert complete("topic", "pub", "/new", "std_msgs/msg/Strin") == ["std_msgs/msg/String"]


def test_empty_domain_completes_only_commands() -> None:
    assert complete("node", "info", "") == []
    assert {"attach", "up", "down", "topic"} <= set(complete(""))
    assert complete("up", "in") == ["indoor"]
