"""Whether programs started by launches join the domain: not if the present system is isolated in its process.

It is a separate module because verbs that start nothing set it, too.
"""

from __future__ import annotations

import os

RANGE_VARIABLE = "ROS_AUTOMATIC_DISCOVERY_RANGE"
"""Not imported from `rmw`: launch, which uses this module, does not depend on the middleware."""

_meet = False


def let_children_meet(meet: bool) -> None:
    """Allow programs started by launches to join the domain, as this program does, or keep them separate."""
    global _meet
    _meet = meet


def children_meet() -> bool:
    """Whether they join the domain; never if the environment keeps programs from discovering each other."""
    return _meet and os.environ.get(RANGE_VARIABLE, "") != "OFF"
