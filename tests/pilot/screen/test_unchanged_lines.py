"""While the robot moves, a list that shows nothing of it is not drawn again."""

from __future__ import annotations

from dataclasses import replace
from unittest.mock import patch

import pytest
from bot_console.tui.console.robot.robot_model import Pose
from bot_console.tui.widgets.row_list import RowList
from piloting import Session, run
from samples import empty, live

LISTS = "12789HMB"


@pytest.mark.parametrize(
    ("system", "keys"),
    [
        pytest.param(live, LISTS[:2], id="live, first"),
        pytest.param(live, LISTS[2:], id="live", marks=pytest.mark.slow),
        pytest.param(empty, LISTS, id="empty", marks=pytest.mark.slow),
    ],
)
def test_unrelated_lines_are_not_redrawn_while_the_robot_moves(system, keys: str) -> None:
    async def play(session: Session) -> None:
        for key in keys:
            await session.press(key)
            with patch.object(RowList, "render_line", autospec=True, side_effect=RowList.render_line) as drawn:
                for x in range(5):
                    world = session.console.current.world
                    session.console.change(world=replace(world, pose=Pose(float(x), 3.0, 0.0)))
                    await session.settle()
            assert drawn.call_count == 0, session.app.current_pane

    run(system(), play, (120, 30))


def test_changed_value_of_the_same_width_redraws_only_its_row() -> None:
    async def play(session: Session) -> None:
        await session.press("H")
        changes = session.console.journal
        with patch.object(RowList, "render_line", autospec=True, side_effect=RowList.render_line) as drawn:
            session.console.journal[:] = [replace(changes[0], reason="another"), *changes[1:]]
            session.console.change(journal=replace(session.console.current.journal, first=-len(changes)))
            await session.settle()
        assert drawn.call_count == 1

    run(live(), play, (120, 30))


def test_console_is_polled_once_per_refresh() -> None:
    async def play(session: Session) -> None:
        await session.press("0")
        with patch.object(session.console, "snapshot", side_effect=session.console.snapshot) as asked:
            session.app._heartbeat()
        assert asked.call_count == 1

    run(live(), play, (120, 40))
