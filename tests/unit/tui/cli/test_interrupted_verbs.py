"""Commands ended by Ctrl-C or SIGTERM: no traceback, the shell's usual exit code, and a message if it matters."""

from __future__ import annotations

from collections.abc import Callable

import pytest
import rclpy
from bot_console.runtime.programs.exit_messages import run_and_report
from bot_console.tui.cli.main import main
from bot_console.tui.cli.verbs import background
from bot_console.tui.session import reached_stop
from domains import unused_domain
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from ros2cli.direct_node import DirectNode

UNHEARD = "bot-console {} was ended before a robot answered\n"


def terminated(*_: object) -> None:
    """Do what the handler of SIGTERM does while a verb looks for a robot."""
    rclpy.get_default_context().shut_down_by_signal()


def interrupted(*_: object) -> None:
    raise KeyboardInterrupt


@pytest.fixture(autouse=True)
def domain(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_DOMAIN_ID", str(unused_domain()))


@pytest.mark.parametrize(("end", "code"), [(terminated, 143), (interrupted, 130)])
@pytest.mark.parametrize("verb", ["stop", "release"])
def test_interrupted_stop_reports_that_no_robot_answered(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], verb: str, end: Callable[[], None], code: int
) -> None:
    monkeypatch.setattr(reached_stop.ReachedStop, "follow", end)
    assert run_and_report(lambda: main([verb])) == code
    assert capsys.readouterr().err == UNHEARD.format(verb)


@pytest.mark.parametrize("step", ["get_topic_names_and_types", "create_subscription", "create_publisher"])
def test_sigterm_raises_external_shutdown_wherever_it_arrives(monkeypatch: pytest.MonkeyPatch, step: str) -> None:
    def ended(node: Node, *words: object) -> None:
        terminated()
        raise RuntimeError("the context is invalid")

    monkeypatch.setattr(Node, step, ended)
    with pytest.raises(ExternalShutdownException), DirectNode() as node:
        getattr(node, step)()


@pytest.mark.parametrize(("end", "code"), [(terminated, 143), (interrupted, 130)])
def test_interrupted_status_prints_nothing(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], end: Callable[[], None], code: int
) -> None:
    monkeypatch.setattr(background, "take_part", lambda: "")
    monkeypatch.setattr(background, "_running_system", lambda: None)
    monkeypatch.setattr(background, "running_robot_nodes", lambda: ["/simulator"])
    monkeypatch.setattr(reached_stop.ReachedStop, "follow", end)
    assert run_and_report(lambda: main(["status"])) == code
    assert capsys.readouterr().err == ""
