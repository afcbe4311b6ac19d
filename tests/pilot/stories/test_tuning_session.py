"""From finding a parameter among thousands to loading a saved file, by keys alone and by mouse alone."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import MappingProxyType

import pytest
from bot_console.tui.console.model import ParameterTree
from bot_console.tui.panes.parameters.table import ParameterRows
from bot_console.tui.panes.plot.pane import PlotPane
from bot_console.tui.settings.appearance import Appearance
from fakes.console import FakeConsole
from piloting import Session, run
from samples import live

NAVIGATOR = "/robot_navigator"


def crowded_system() -> tuple[FakeConsole, object]:
    """The live system among 100 nodes of 25 parameters each."""
    console, launcher = live()
    pattern = console.current.parameters["/simulator"].parameters[0]
    trees = dict(console.current.parameters)
    for number in range(100):
        node = f"/crowd/n{number:03d}"
        trees[node] = ParameterTree(node, tuple(replace(pattern, node=node, name=f"p{at:02d}") for at in range(25)))
    console.change(parameters=MappingProxyType(dict(sorted(trees.items()))))
    return console, launcher


def value(session: Session, name: str) -> object:
    return session.console.current.parameters[NAVIGATOR].get(name).value


async def find(session: Session, words: str) -> None:
    await session.press("1", "slash", "ctrl+u")
    await session.type(words)
    await session.press("enter")


async def type_value(session: Session, text: str) -> None:
    await session.press("e")
    await session.type(text)
    await session.press("enter")


@pytest.mark.soak
def test_tuning_session_works_by_keyboard_from_search_to_restart(tmp_path: Path) -> None:
    file = tmp_path / "mine.yaml"

    async def tune(session: Session) -> None:
        await find(session, "max_speed")
        assert session.pane(ParameterRows).current.parameter.name == "max_speed"
        await type_value(session, "99")
        assert value(session, "max_speed") == 1.0 and "✗ 99.0" in session.text()
        await type_value(session, "0.8")
        assert value(session, "max_speed") == 0.8
        await session.press("p")
        assert f"{NAVIGATOR}:max_speed" in session.pane(PlotPane).paths
        await find(session, "turn_rate")
        await session.press("m")
        await type_value(session, "0.9")
        await find(session, "safety_distance")
        await type_value(session, "0.9")
        assert (value(session, "turn_rate"), value(session, "safety_distance")) == (1.0, 0.8), "marked, not sent"
        await session.press("a")
        assert (value(session, "turn_rate"), value(session, "safety_distance")) == (0.9, 0.9)
        await session.press("m")
        await type_value(session, "1.0")
        await session.press("A")
        assert value(session, "safety_distance") == 1.0
        await session.press("A")
        assert "lowers a safety margin" in session.text(), "going back needs a confirmation"
        await session.press("y")
        assert value(session, "safety_distance") == 0.9
        await session.press("H")
        await session.press("slash")
        await session.type("turn_rate taken 0.9")
        await session.press("enter", "u", "y")
        assert value(session, "turn_rate") == 0.9 and value(session, "max_speed") == 0.8
        await session.press("1", "escape", "s", "enter")
        await session.press("ctrl+u")
        await session.type(str(file))
        await session.press("enter")
        assert "max_speed: 0.8" in file.read_text()

    async def load(session: Session) -> None:
        await session.press("7", "o")
        await session.press("ctrl+u")
        await session.type(str(file))
        await session.press("enter")
        await session.press("a", "y")
        assert (value(session, "max_speed"), value(session, "turn_rate")) == (0.8, 0.9)

    run(crowded_system(), tune, (120, 40))
    run(crowded_system(), load, (120, 40))


async def help_line(session: Session, words: str) -> None:
    """Click on Help in the key bar, then on a line of it."""
    await session.click("? Help")
    await session.click(words)


async def slide(session: Session, name: str, share: float) -> None:
    """Click into the slider of one of the navigator's parameters, at a share of its length."""
    y, line = next((y, line) for y, line in enumerate(session.lines()) if f" {name} " in line and "●" in line)
    begin, end = line.index("─"), line.rindex("─")
    await session.pilot.click(offset=(begin + round(share * (end - begin)), y))
    await session.settle()


@pytest.mark.soak
def test_tuning_session_works_by_mouse_alone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    left: list[object] = []
    names = ("max_speed", "turn_rate", "safety_distance")

    async def tune(session: Session) -> None:
        nonlocal left
        session.console.folder = tmp_path
        await session.click_tab("1")
        await session.click("▸ /robot_navigator")
        await session.click("max_speed")
        assert session.pane(ParameterRows).current.parameter.name == "max_speed"
        session.console.refusals[NAVIGATOR, "max_speed"] = "not while it drives"
        await slide(session, "max_speed", 0.2)
        assert value(session, "max_speed") == 1.0 and "not while it drives" in session.text()
        session.console.refusals.clear()
        await session.click("- Less")
        assert value(session, "max_speed") < 1.0
        await slide(session, "max_speed", 0.1)
        await help_line(session, "Plot this parameter")
        assert f"{NAVIGATOR}:max_speed" in session.pane(PlotPane).paths
        await session.click_tab("1")
        await help_line(session, "Mark edits instead")
        before = [value(session, name) for name in names]
        await slide(session, "turn_rate", 0.2)
        await slide(session, "safety_distance", 0.9)
        assert [value(session, name) for name in names] == before, "marked, not sent"
        await help_line(session, "Apply what is marked")
        assert value(session, "turn_rate") < before[1] and value(session, "safety_distance") > before[2]
        await help_line(session, "Mark edits instead")
        await slide(session, "turn_rate", 0.4)
        set_a = value(session, "turn_rate")
        await help_line(session, "Send what is marked as set B")
        if len(session.app.screen_stack) > 1:
            await session.click("y yes", last=True)
        assert value(session, "turn_rate") != set_a
        await help_line(session, "Send what is marked as set B")
        assert value(session, "turn_rate") == set_a
        await session.click_tab("H")
        await session.click(f"→ {before[0]} ")
        await session.click("u Back to here")
        await session.click("y yes", last=True)
        left = [value(session, name) for name in names]
        assert left == before
        await session.click_tab("1")
        await help_line(session, "Save to a ROS parameter file")
        await session.click(f"this node: {NAVIGATOR}", times=2)
        await session.click("enter OK")
        assert f"turn_rate: {left[1]}" in (tmp_path / "parameters.yaml").read_text()

    async def load(session: Session) -> None:
        assert [value(session, name) for name in names] != left
        await session.click_tab("7")
        await session.click("o Open")
        await session.click("enter OK")
        await session.click("a Apply")
        assert [value(session, name) for name in names] == left

    appearance = Appearance()
    run(crowded_system(), tune, (120, 60), appearance=appearance)
    run(live(), load, (120, 60), appearance=appearance)
