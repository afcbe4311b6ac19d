"""`ros2 action` on a running server."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from systems import System, system

SERVER = Path(__file__).parents[1] / "rclpy" / "programs" / "fibonacci_server.py"
FIBONACCI = "example_interfaces/action/Fibonacci"


@pytest.fixture
def running() -> Iterator[System]:
    with system() as made:
        made.python(str(SERVER))
        made.run(0.5)
        yield made


@pytest.mark.parametrize(
    ("words", "shown"),
    [
        ("list", "/fibonacci\n"),
        ("list -t", f"/fibonacci [{FIBONACCI}]\n"),
        ("list -c", "1\n"),
        ("type /fibonacci", f"{FIBONACCI}\n"),
        ("info /fibonacci", "Action: /fibonacci\nAction clients: 0\nAction servers: 1\n    /fibonacci_server\n"),
        (
            "info fibonacci -t",
            f"Action: fibonacci\nAction clients: 0\nAction servers: 1\n    /fibonacci_server [{FIBONACCI}]\n",
        ),
        ("info /fibonacci -c", "Action: /fibonacci\nAction clients: 0\nAction servers: 1\n"),
        ("info /nothing", "Action: /nothing\nAction clients: 0\nAction servers: 0\n"),
    ],
)
def test_list_info_and_type_are_printed(running: System, words: str, shown: str) -> None:
    asked = running.ask("action", *words.split())
    assert (asked.stdout, asked.stderr, asked.exit) == (shown, "", 0)


@pytest.mark.parametrize(
    ("words", "reported"),
    [
        (("type", "/nothing"), ""),
        (("send_goal", "/fibonacci", "nonsense", "{}"), "The passed action type is invalid\n"),
        (("send_goal", "/fibonacci", "std_msgs/msg/String", "{}"), "The passed action type is invalid\n"),
        (
            ("send_goal", "/fibonacci", FIBONACCI, "{ordr: 1}"),
            "Failed to populate message fields: AttributeError(\"'Fibonacci_Goal' object has no attribute 'ordr'\")\n",
        ),
    ],
)
def test_invalid_goals_are_refused(running: System, words: tuple[str, ...], reported: str) -> None:
    asked = running.ask("action", *words)
    assert (asked.stdout, asked.stderr, asked.exit) == ("", reported, 1)


def test_invalid_action_name_is_refused(running: System) -> None:
    asked = running.ask("action", "info", "a b")
    assert (asked.stdout, asked.exit) == ("", 1)
    assert asked.stderr.startswith("topic name 'a b' is invalid: ")


def test_send_goal_prints_feedback(running: System) -> None:
    asked = running.ask("action", "send_goal", "-f", "/fibonacci", FIBONACCI, "{order: 3}")
    assert re.sub(r"[0-9a-f]{32}", "<id>", asked.stdout) == (
        "Waiting for an action server to become available...\n"
        "Sending goal:\n     order: 3\n\n"
        "Goal accepted with ID: <id>\n\n"
        "Feedback:\n    sequence:\n- 0\n- 1\n- 1\n\n"
        "Feedback:\n    sequence:\n- 0\n- 1\n- 1\n- 2\n\n"
        "Result:\n    sequence:\n- 0\n- 1\n- 1\n- 2\n\n"
        "Goal finished with status: SUCCEEDED\n"
    )
    assert (asked.stderr, asked.exit) == ("", 0)


def test_send_goal_reports_rejection(running: System) -> None:
    asked = running.ask("action", "send_goal", "/fibonacci", FIBONACCI, "{order: -1}")
    assert asked.stdout.endswith("\nGoal was rejected.\n")
    assert asked.exit == 0


def test_ctrl_c_cancels_the_goal(running: System) -> None:
    asked = running.ask("action", "send_goal", "/fibonacci", FIBONACCI, "{order: 40}", stop_after=3.0)
    assert asked.stdout.endswith("Canceling goal...\nGoal canceled.\n")
    assert (asked.stderr, asked.exit) == ("", 2)


def test_send_goal_waits_for_a_server() -> None:
    with system() as running:
        asked = running.ask("action", "send_goal", "/fibonacci", FIBONACCI, "{order: 1}", stop_after=3.0)
    assert asked.stdout == "Waiting for an action server to become available...\n"
    assert (asked.stderr, asked.exit) == ("", 2)


def test_node_info_names_actions(running: System) -> None:
    asked = running.ask("node", "info", "/fibonacci_server")
    assert "  Action Servers:\n    /fibonacci: example_interfaces/action/Fibonacci\n  Action Clients:\n" in asked.stdout
    assert "_action" not in asked.stdout
