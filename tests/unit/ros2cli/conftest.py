"""A system with nodes of our own, that commands are asked of."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from systems import Program, System, system

HEAD = "import rclpy\nfrom rclpy.node import Node\nrclpy.init()\n"


class Asked(System):
    """A system whose nodes are written in the test."""

    def node(self, text: str, seconds: float = 0.1) -> Program:
        """Start a program that has rclpy at hand; `node`, where it makes one, is spun."""
        spin = "\nrclpy.spin(node)" if "node =" in text else ""
        program = self.python("-c", f"{HEAD}{text}{spin}")
        self.run(seconds)
        assert program.exit is None, program.stderr
        return program


@pytest.fixture
def ros() -> Iterator[Asked]:
    """Time stands still but while a command runs."""
    with system() as running:
        yield Asked(running.clock)
