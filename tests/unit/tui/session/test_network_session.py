"""The console that `attach --connect` shows."""

from __future__ import annotations

import contextlib
import os
import threading
from typing import Any

import pytest
import rclpy
from bot_console.runtime.rmw.zenoh.link_probe import LinkState
from bot_console.runtime.rmw.zenoh.network.client import ClientConfig
from bot_console.tui.cli.arguments import Options
from bot_console.tui.cli.attach_options import AttachOptions
from bot_console.tui.console.graph import unresponsive_nodes
from bot_console.tui.console.model import GraphInfo, NodeInfo
from bot_console.tui.console.ros_console import RosConsole
from bot_console.tui.session import network
from domains import unused_domain
from rclpy.context import Context
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rigs import until


class Connection:
    """Replaces the connection to a router: the robot is in this process."""

    def other_domains(self, domain: int) -> str:
        return ""

    def link(self) -> LinkState:
        return LinkState()

    def close(self) -> None:
        pass


def test_console_on_a_network_finds_the_node_that_hangs(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "environ", {**os.environ, "ROS_DOMAIN_ID": str(unused_domain())})
    monkeypatch.setattr(unresponsive_nodes, "POLL_S", 0.02)
    monkeypatch.setattr(network, "connect", lambda _: Connection())
    monkeypatch.setattr(network, "choose", lambda _: None)
    silent: list[tuple[str, ...]] = []

    class Screen:
        """A session in which the Graph pane is visible until a node is silent."""

        def __init__(self, console: RosConsole, *_: Any, **__: Any) -> None:
            self._console = console

        def run(self) -> int:
            self._console.start()
            self._console.graph.watch_nodes(True, "graph")
            try:
                until(self._has_found_it, "the node that hangs")
            finally:
                self._console.close()
            return 0

        def _has_found_it(self) -> bool:
            silent.append(self._console.snapshot().graph.silent)
            return silent[-1] == ("/hung",)

    monkeypatch.setattr(network, "AttachedSession", Screen)
    context = Context()
    rclpy.init(args=[], context=context, domain_id=int(os.environ["ROS_DOMAIN_ID"]))
    rclpy.create_node("hung", context=context)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(rclpy.create_node("answers", context=context))
    thread = threading.Thread(target=spin, args=(executor,))
    thread.start()
    try:
        assert network.run_network(AttachOptions(Options(), ClientConfig(("tcp/robot:7447",)))) == 0
    finally:
        context.shutdown()
        thread.join()
    assert silent[-1] == ("/hung",)


def spin(executor: SingleThreadedExecutor) -> None:
    with contextlib.suppress(ExternalShutdownException):
        executor.spin()


@pytest.mark.parametrize(("here", "logged"), [("/_bot_console", ["nodes are in 0"]), ("/robot", [])])
def test_console_says_once_that_the_nodes_are_in_another_domain(
    monkeypatch: pytest.MonkeyPatch, here: str, logged: list[str]
) -> None:
    answers, lines = iter(["", "nodes are in 0"]), list[str]()
    monkeypatch.setattr(network, "OTHER_DOMAINS_POLL_S", 0.001)
    graph = GraphInfo(nodes=(NodeInfo(here),))
    network.report_other_domains(
        lambda domain: next(answers), lambda: graph, lambda _, __, text: lines.append(text), threading.Event()
    )
    assert lines == logged
