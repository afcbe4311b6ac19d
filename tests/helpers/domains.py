"""ROS domains for tests: each that creates nodes gets one in which there are no others."""

import itertools
import os
from collections.abc import Iterator

DOMAINS_PER_WORKER = 27
"""For the three workers of `.ci/on_rclpy`, domains 20 to 100; DDS allows 101 on every system."""


def _domains() -> Iterator[int]:
    if os.environ.get("BOT_CONSOLE_TESTS_ON") != "ros":
        return itertools.count(1000)  # the embedded runtime has as many as integers
    worker = int(os.environ.get("PYTEST_XDIST_WORKER", "gw0").removeprefix("gw"))
    first = 20 + worker % 3 * DOMAINS_PER_WORKER
    return itertools.cycle(range(first, first + DOMAINS_PER_WORKER))


_unused = _domains()


def unused_domain() -> int:
    """A ROS domain that neither the tests before this one nor those of other workers use.

    A node that a test leaves behind would otherwise be in the graph of a later test.
    """
    return next(_unused)
