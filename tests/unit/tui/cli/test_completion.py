"""Completion of names in a running system, queried over a real domain of another process."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from processes.command_line import run_cli
from processes.two_processes import two_processes

if os.name == "nt":
    pytest.skip("needs Unix sockets", allow_module_level=True)


def complete(*words: str) -> list[str]:
    done = run_cli("complete", "bot-console", *words)
    assert done.returncode == 0
    return done.stdout.split()


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
