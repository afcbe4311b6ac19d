"""Spreads a flow chart vertically over rows that would otherwise stay free. Pure."""

from __future__ import annotations

from dataclasses import replace

from bot_console.tui.widgets.diagram.flow_chart.plan import Plan

KEPT_ROWS = 14
"""Rows of the window reserved for the description of the selected item."""
MAX_FACTOR = 2
MIN_ROWS = 6
"""Minimum rows of a plan that is spread: a short chain can be taken in at a glance as it is."""


def spread(plan: Plan, height: int) -> Plan:
    """Multiply the height of boxes and gaps as far as a window of this height has room, at most by `MAX_FACTOR`.

    A plan without links, or with boxes that have no frame or several members, is not changed.
    """
    factor = min(MAX_FACTOR, (height - KEPT_ROWS - 1) // max(1, plan.height - 1))
    roomy = all(each.framed and len(each.box.members) == 1 for each in plan.placed.values())
    if factor < 2 or plan.height < MIN_ROWS or not plan.forward or not roomy:
        return plan
    placed = {
        name: replace(
            each,
            y=each.y * factor,
            height=(each.height - 1) * factor + 1,
            out=each.out * factor,
            back_row=each.back_row * factor,
            ports_in={link: row * factor for link, row in each.ports_in.items()},
        )
        for name, each in plan.placed.items()
    }
    labels = [replace(each, y=each.y * factor) for each in plan.labels]
    return replace(plan, placed=placed, labels=labels, height=(plan.height - 1) * factor + 1)
