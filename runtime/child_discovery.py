"""Whether programs started by launches join the domain: not if what runs here is isolated in its process.

A module of its own, because verbs that start nothing set it too.
"""

from __future__ import annotations

_meet = False


def let_children_meet(meet: bool) -> None:
    """Let the programs that launches start take part in the domain, as this program does, or keep them apart."""
    global _meet
    _meet = meet


def children_meet() -> bool:
    """Whether they take part."""
    return _meet
