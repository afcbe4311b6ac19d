"""`LifecycleTransition` needs nodes and transitions."""

from __future__ import annotations

import pytest
from launch_ros.actions import LifecycleTransition


@pytest.mark.parametrize(
    ("nodes", "transitions", "missing"),
    [([], [1], "at least one lifecycle node name"), (["a"], [], "at least one lifecycle node transition id")],
)
def test_transition_without_nodes_or_ids_is_refused(nodes: list[str], transitions: list[int], missing: str) -> None:
    with pytest.raises(ValueError, match=missing):
        LifecycleTransition(lifecycle_node_names=nodes, transition_ids=transitions)
