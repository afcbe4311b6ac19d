"""Sliders of Parameters, dragged with the mouse."""

from __future__ import annotations

import pytest
from bot_console.tui.panes.parameters.table import ParameterRows
from piloting import Session, run
from samples import live

CELLS_BEYOND = 30


@pytest.mark.parametrize(("across", "down", "value"), [(CELLS_BEYOND, 2, 5.0), (-CELLS_BEYOND, -1, 0.1)])
def test_a_slider_that_is_dragged_across_other_rows_sets_only_its_own_parameter(
    across: int, down: int, value: float
) -> None:
    async def play(session: Session) -> None:
        await session.press("1")
        rows = session.pane(ParameterRows)
        y, line = next((y, line) for y, line in enumerate(session.lines()) if " max_speed " in line and "●" in line)
        slider = line.index("─") - rows.region.x + 3, y - rows.region.y
        await session.pilot.mouse_down(rows, offset=slider)
        await session.pilot.hover(offset=(rows.region.x + slider[0] + across, y + down))
        await session.pilot.mouse_up(offset=(rows.region.x + slider[0] + across, y + down))
        await session.settle()
        await session.pilot.mouse_up(rows, offset=(slider[0], slider[1] + 1))  # pressed somewhere else
        await session.settle()
        sent = [each[1:] for each in session.console.asked if each[0] == "set"]
        assert sent == [("/robot_navigator", {"max_speed": value})]
        assert rows.current.parameter.name == "max_speed" and not session.app.mouse_captured

    run(live(), play, (120, 30))
