"""Programs with actions, in the style of the public tutorials."""

from __future__ import annotations

import re
from pathlib import Path

from systems import Program, system

PROGRAMS = Path(__file__).parent / "programs"


def message(program: Program) -> list[tuple[int, str]]:
    """The messages that a program logged, with the time (s) since the start of the run."""
    lines = re.findall(r"\[INFO\] \[(\d+)\.\d+\] \[\w+\]: (.*)", program.stderr)
    return [(int(seconds) - 1_700_000_000, text) for seconds, text in lines]


def test_client_receives_feedback_and_result() -> None:
    with system() as running:
        server = running.python(str(PROGRAMS / "fibonacci_server.py"))
        client = running.finish(running.python(str(PROGRAMS / "fibonacci_client.py"), "4", "0"))
    assert client.exit == 0
    assert message(client) == [
        (0, "accepted"),
        (0, "feedback [0, 1, 1]"),
        (1, "feedback [0, 1, 1, 2]"),
        (2, "feedback [0, 1, 1, 2, 3]"),
        (3, "succeeded [0, 1, 1, 2, 3]"),
    ]
    assert message(server) == [(0, "goal of order 4")]


def test_goal_can_be_canceled() -> None:
    with system() as running:
        server = running.python(str(PROGRAMS / "fibonacci_server.py"))
        client = running.finish(running.python(str(PROGRAMS / "fibonacci_client.py"), "40", "2.5"))
    assert message(client)[-2:] == [(2, "canceling 1"), (3, "canceled [0, 1, 1, 2, 3]")]
    assert message(server) == [(0, "goal of order 40"), (2, "asked to cancel"), (3, "canceled")]


def test_goal_can_be_rejected() -> None:
    with system() as running:
        running.python(str(PROGRAMS / "fibonacci_server.py"))
        client = running.finish(running.python(str(PROGRAMS / "fibonacci_client.py"), "-1", "0"))
    assert message(client) == [(0, "rejected")]


def test_client_waits_for_its_server() -> None:
    with system() as running:
        client = running.python(str(PROGRAMS / "fibonacci_client.py"), "1", "0")
        running.run(5.0)
        assert message(client) == []
        running.python(str(PROGRAMS / "fibonacci_server.py"))
        running.finish(client)
    assert message(client) == [(5, "accepted"), (5, "succeeded [0, 1]")]


def test_two_clients_are_served_concurrently() -> None:
    with system() as running:
        running.python(str(PROGRAMS / "fibonacci_server.py"))
        clients = [running.python(str(PROGRAMS / "fibonacci_client.py"), order, "0") for order in ("3", "5")]
        for client in clients:
            running.finish(client)
    assert [message(client)[-1] for client in clients] == [
        (2, "succeeded [0, 1, 1, 2]"),
        (4, "succeeded [0, 1, 1, 2, 3, 5]"),
    ]


def test_single_goal_server_aborts_previous_goal() -> None:
    with system() as running:
        server = running.python(str(PROGRAMS / "single_goal_server.py"))
        words = ("action", "send_goal", "/fibonacci", "example_interfaces/action/Fibonacci")
        first = running.ros2(*words, "{order: 10}")
        running.run(2.5)
        second = running.ask(*words, "{order: 2}")
        running.finish(first)
    assert "Goal finished with status: ABORTED" in first.stdout
    assert "Goal finished with status: SUCCEEDED" in second.stdout
    assert message(server) == [(2, "aborting the goal before")]
