"""Names in the graph: hidden ones, and actions, recognised by their topics and services."""

from __future__ import annotations

from collections.abc import Sequence

NamesAndTypes = Sequence[tuple[str, Sequence[str]]]

SEND_GOAL = "/_action/send_goal"
GOAL_SUFFIX = "_SendGoal"


def hidden(name: str) -> bool:
    """Whether any token of a topic or service name starts with an underscore."""
    return "/_" in name or name.startswith("_")


def without_actions(rows: NamesAndTypes, include_hidden: bool) -> list[tuple[str, Sequence[str]]]:
    """Rows sorted by name, without hidden ones (and so without the parts of actions)."""
    return sorted((name, types) for name, types in rows if include_hidden or not hidden(name))


def action_names_and_types(services: NamesAndTypes) -> list[tuple[str, Sequence[str]]]:
    """Actions with their types, derived from the goal services among the given services."""
    return sorted(
        (name[: -len(SEND_GOAL)], [each.removesuffix(GOAL_SUFFIX) for each in types])
        for name, types in services
        if name.endswith(SEND_GOAL)
    )
