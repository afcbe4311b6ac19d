"""The order in which the boxes of a flow chart are placed: along the longest chains, with few backward links.

Pure.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from bot_console.tui.widgets.diagram.columns import greedy_order
from bot_console.tui.widgets.diagram.flow_chart.model import Chart


def order_boxes(chart: Chart) -> list[list[str]]:
    """The ids of all linked boxes in order, one list for each group of connected boxes, largest group first."""
    after: dict[str, set[str]] = {each.id: set() for each in chart.boxes}
    near: dict[str, set[str]] = {each.id: set() for each in chart.boxes}
    for link in chart.links:
        after[link.source].add(link.target)
        near[link.source].add(link.target)
        near[link.target].add(link.source)
    groups = [sorted(each) for each in _groups(near) if len(each) > 1]
    return [_along_chains(each, after) for each in sorted(groups, key=lambda each: (-len(each), each))]


def _groups(near: Mapping[str, set[str]]) -> Iterable[set[str]]:
    left = set(near)
    while left:
        found = frontier = {min(left)}
        while frontier:
            frontier = {one for each in frontier for one in near[each]} - found
            found = found | frontier
        left -= found
        yield found


def _along_chains(boxes: list[str], after: Mapping[str, set[str]]) -> list[str]:
    before: dict[str, set[str]] = {each: set() for each in boxes}
    for each in boxes:
        for target in after[each]:
            before[target].add(each)
    gives = {each: len(after[each]) - len(before[each]) for each in boxes}
    at = {each: number for number, each in enumerate(greedy_order(boxes, after, gives))}
    length: dict[str, int] = {}
    for each in sorted(boxes, key=lambda box: -at[box]):
        length[each] = 1 + max((length[one] for one in after[each] if at[one] > at[each]), default=0)
    waits = {each: sum(1 for one in before[each] if at[one] < at[each]) for each in boxes}
    ready = {each for each in boxes if not waits[each]}
    found: list[str] = []
    while ready:
        on = {each for each in ready if found and each in after[found[-1]]}
        best = min(on or ready, key=lambda each: (-length[each], at[each]))
        # The chain continues with a short side branch only if nothing longer is ready.
        if on and length[best] == 1:
            best = min(ready, key=lambda each: (-length[each], each not in on, at[each]))
        ready.remove(best)
        found.append(best)
        for each in after[best]:
            if at[each] > at[best]:
                waits[each] -= 1
                if not waits[each]:
                    ready.add(each)
    return found
