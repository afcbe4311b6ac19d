"""How an exception that nobody caught is printed."""

from __future__ import annotations

import subprocess
import sys

UNCAUGHT = """
from bot_console.runtime.process.frames import print_exception
class Node:
    create_publisher = 1
try:
    Node().create_publsher
except AttributeError as error:
    print_exception(error)
"""


def test_a_mistyped_name_comes_with_the_interpreter_s_suggestion() -> None:
    printed = subprocess.run([sys.executable, "-c", UNCAUGHT], check=True, capture_output=True, text=True).stderr
    assert printed.endswith(
        "AttributeError: 'Node' object has no attribute 'create_publsher'. Did you mean: 'create_publisher'?\n"
    )
