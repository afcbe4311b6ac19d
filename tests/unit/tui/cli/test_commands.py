"""Commands are imported when they are used: each name resolves to a function."""

from __future__ import annotations

import pytest
from bot_console.tui.cli import main as program
from bot_console.tui.cli import open_console


@pytest.mark.parametrize("place", sorted({*program._COMMANDS.values(), *program._ROS2.values()}))
def test_every_command_has_its_function(place: str) -> None:
    assert callable(program._load(place))


@pytest.mark.parametrize(
    ("line", "attached"),
    [
        ("rqt", True),
        ("ros2 run rqt_plot rqt_plot /a/b", True),
        ("rqt_plot --theme dark", True),
        ("rqt_plot /a/b outdoor", False),
    ],
)
def test_rqt_program_starts_no_robot_unless_asked(line: str, attached: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    shown: list[str] = []
    monkeypatch.setattr(program, "others_take_part", lambda: False)
    monkeypatch.setattr(program, "_attach", lambda words: shown.append("attached") or 0)
    monkeypatch.setattr(open_console, "run", lambda options: shown.append("own") or 0)
    assert program.main(line.split()) == 0
    assert shown == ["attached" if attached else "own"]
