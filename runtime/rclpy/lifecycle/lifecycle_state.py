"""The state of a managed node, as its callbacks receive it."""

from __future__ import annotations

from typing import NamedTuple


class LifecycleState(NamedTuple):
    """A lifecycle state, as passed to transition callbacks."""

    label: str
    state_id: int
