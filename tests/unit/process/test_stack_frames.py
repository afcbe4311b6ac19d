"""How an uncaught exception is printed."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable

import pytest
from bot_console.runtime.process import stack_frames
from bot_console.runtime.process.stack_frames import format_exception

UNCAUGHT = """
from bot_console.runtime.process.stack_frames import print_exception
class Node:
    create_publisher = 1
try:
    Node().create_publsher
except AttributeError as error:
    print_exception(error)
"""


def test_mistyped_name_has_the_interpreters_suggestion() -> None:
    printed = subprocess.run([sys.executable, "-c", UNCAUGHT], check=True, capture_output=True, text=True).stderr
    assert printed.endswith(
        "AttributeError: 'Node' object has no attribute 'create_publsher'. Did you mean: 'create_publisher'?\n"
    )


class Node:
    """A class with a method name to mistype."""

    create_publisher = 1


@pytest.mark.parametrize(
    ("mistyped", "end"),
    [
        (lambda: getattr(Node(), "create_publsher"), "'create_publsher'. Did you mean: 'create_publisher'?\n"),  # noqa: B009 -- mistyped
        (lambda: 1 // 0, "ZeroDivisionError: integer division or modulo by zero\n"),
    ],
)
def test_formatted_exception_equals_what_the_interpreter_prints(mistyped: Callable[[], object], end: str) -> None:
    with pytest.raises(Exception) as caught:
        mistyped()
    text = format_exception(caught.value)
    assert text.startswith("Traceback (most recent call last):\n")
    assert text.endswith(end)


def test_shipped_nodes_in_an_installed_wheel_do_not_count_as_a_library(monkeypatch: pytest.MonkeyPatch) -> None:
    site = "/home/me/.venv/lib/python3.12/site-packages/"
    monkeypatch.setattr(stack_frames, "_SHIPPED", (site + "bot_console/",))
    assert not stack_frames.is_library(site + "bot_console/nodes/robot_node.py")
    assert stack_frames.is_library(site + "numpy/core.py")


def test_library_in_an_environment_within_a_clone_counts_as_a_library(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stack_frames, "_SHIPPED", ("/home/me/bot-console/",))
    assert stack_frames.is_library("/home/me/bot-console/.venv/lib/python3.12/site-packages/numpy/core.py")
