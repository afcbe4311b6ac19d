"""A system on which commands run, with nodes written in the test."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from systems import Program, System, system

HEAD = "import rclpy\nfrom rclpy.node import Node\nrclpy.init()\n"


class CommandSystem(System):
    """A system whose nodes are written in the test."""

    def node(self, text: str, seconds: float = 0.1) -> Program:
        """Start a program that has rclpy imported; spin `node` if the program creates one."""
        spin = "\nrclpy.spin(node)" if "node =" in text else ""
        program = self.python("-c", f"{HEAD}{text}{spin}")
        self.run(seconds)
        assert program.exit is None, program.stderr
        return program


@pytest.fixture
def ros() -> Iterator[CommandSystem]:
    """A system whose time advances only while a command runs."""
    with system() as running:
        yield CommandSystem(running.clock)
