"""Commands are imported when they are named: each name leads to a function."""

from __future__ import annotations

import pytest
from bot_console.tui.cli import main as program


@pytest.mark.parametrize("place", sorted({*program._COMMANDS.values(), *program._ROS2.values()}))
def test_what_a_command_names_is_there(place: str) -> None:
    assert callable(program._imported(place))
