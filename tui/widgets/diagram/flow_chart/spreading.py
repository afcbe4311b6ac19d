"""Spreads a flow chart over rows that would stay free. Pure."""

from __future__ import annotations

from dataclasses import replace

from bot_console.tui.widgets.diagram.flow_chart.plan import Plan

KEPT_ROWS = 14
"""Rows of the window that are left for what is said about the selected item."""
MAX_FACTOR = 2
MIN_ROWS = 6
"""Rows of a plan from which on it is spread: a short chain is seen at a glance as it is."""


def spread(plan: Plan, height: int) -> Plan:
    """The plan with boxes and gaps so many times as high as a window of this height has room for.

    Boxes without a frame or without links, and those of several members, stay close.
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
