"""ROS domains for tests: each test that creates nodes gets a domain without other nodes."""

import itertools
import os
from collections.abc import Iterator

DOMAINS_PER_WORKER = 27
"""So that the three workers of `.ci/on_rclpy` use domains 20 to 100: every system has 101 domains with DDS."""


def _domains() -> Iterator[int]:
    if os.environ.get("BOT_CONSOLE_TESTS_ON") != "ros":
        return itertools.count(1000)  # the embedded runtime has a domain for every integer
    worker = int(os.environ.get("PYTEST_XDIST_WORKER", "gw0").removeprefix("gw"))
    first = 20 + worker % 3 * DOMAINS_PER_WORKER
    return itertools.cycle(range(first, first + DOMAINS_PER_WORKER))


_unused = _domains()


def unused_domain() -> int:
    """Return a ROS domain that no earlier test and no other worker uses.

    A node that a test leaves behind would otherwise be in the graph of a later test.
    """
    return next(_unused)
