"""Whether programs that launches start join the domain: not if the current system is isolated in its process.

It is a separate module because verbs that start no programs set it, too.
"""

from __future__ import annotations

import os

RANGE_VARIABLE = "ROS_AUTOMATIC_DISCOVERY_RANGE"
"""Not imported from `rmw`, because launch, which uses this module, does not depend on the middleware."""

_meet = False


def let_children_meet(meet: bool) -> None:
    """Make programs that launches start join the domain, as this program does, or keep them separate."""
    global _meet
    _meet = meet


def children_meet() -> bool:
    """Whether those programs join the domain; never if the environment prevents discovery."""
    return _meet and os.environ.get(RANGE_VARIABLE, "") != "OFF"
