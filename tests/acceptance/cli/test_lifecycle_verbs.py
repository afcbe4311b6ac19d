"""`ros2 lifecycle` on a running managed node."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from systems import System, system

TALKER = Path(__file__).parents[1] / "rclpy" / "programs" / "lifecycle_talker.py"


@pytest.fixture
def running() -> Iterator[System]:
    with system() as made:
        made.python(str(TALKER))
        made.run(0.5)
        yield made


@pytest.mark.parametrize(
    ("words", "shown"),
    [
        ("nodes", "/lc_talker\n"),
        ("nodes -c", "1\n"),
        ("get /lc_talker", "unconfigured [1]\n"),
        ("get lc_talker", "unconfigured [1]\n"),
        ("get", "/lc_talker: unconfigured [1]\n"),
        (
            "list /lc_talker",
            "- configure [1]\n\tStart: unconfigured\n\tGoal: configuring\n"
            "- shutdown [5]\n\tStart: unconfigured\n\tGoal: shuttingdown\n",
        ),
        ("set /lc_talker configure", "Transitioning successful\n"),
        ("set /lc_talker 1", "Transitioning successful\n"),
    ],
)
def test_nodes_states_and_transitions_are_printed(running: System, words: str, shown: str) -> None:
    asked = running.ask("lifecycle", *words.split())
    assert (asked.stdout, asked.stderr, asked.exit) == (shown, "", 0)


@pytest.mark.parametrize(
    ("words", "reported"),
    [
        ("get /nobody", "Node not found\n"),
        ("list /nobody", "Node not found\n"),
        ("set /nobody configure", "Node not found\n"),
        (
            "set /lc_talker activate",
            "Unknown transition requested, available ones are:\n- configure [1]\n- shutdown [5]\n",
        ),
    ],
)
def test_invalid_transitions_are_refused(running: System, words: str, reported: str) -> None:
    asked = running.ask("lifecycle", *words.split())
    assert (asked.stdout, asked.stderr, asked.exit) == ("", reported, 1)


def test_all_transitions_are_listed(running: System) -> None:
    lines = running.ask("lifecycle", "list", "-a", "/lc_talker").stdout.splitlines()
    assert len(lines) == 3 * 25
    assert lines[:6] == [
        "- configure [1]",
        "\tStart: unconfigured",
        "\tGoal: configuring",
        "- transition_success [10]",
        "\tStart: configuring",
        "\tGoal: inactive",
    ]


def test_node_goes_through_all_states(running: System) -> None:
    seen = []
    for step in ("configure", "activate", "deactivate", "cleanup", "shutdown"):
        assert running.ask("lifecycle", "set", "/lc_talker", step).stdout == "Transitioning successful\n"
        seen.append(running.ask("lifecycle", "get", "/lc_talker").stdout)
    assert seen == ["inactive [2]\n", "active [3]\n", "inactive [2]\n", "unconfigured [1]\n", "finalized [4]\n"]


def test_failing_transition_is_reported() -> None:
    refuses = (
        "import rclpy; from rclpy.lifecycle import Node, TransitionCallbackReturn\n"
        "class Refuses(Node):\n"
        "    def on_configure(self, state):\n"
        "        return TransitionCallbackReturn.FAILURE\n"
        "rclpy.init(); rclpy.spin(Refuses('refuses'))\n"
    )
    with system() as running:
        running.python("-c", refuses)
        running.run(0.5)
        asked = running.ask("lifecycle", "set", "/refuses", "configure")
    assert (asked.stdout, asked.stderr, asked.exit) == ("", "Transitioning failed\n", 0)


def test_list_is_empty_without_managed_nodes() -> None:
    with system() as running:
        asked = running.ask("lifecycle", "nodes")
    assert (asked.stdout, asked.stderr, asked.exit) == ("", "", 0)
