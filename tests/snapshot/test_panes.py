"""The appearance of every pane: empty, live, with faults, narrow, and larger. Review differences as design changes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from bot_console.tui.app import BotConsoleApp
from bot_console.tui.arrangement.rqt_command_line import Opening
from bot_console.tui.pane_table import PANES
from bot_console.tui.panes.steering.pane import SteeringPane
from fakes.console import FakeConsole
from fakes.launcher import FakeLauncher
from fleet import fleet
from piloting import Clock
from samples import empty, faulty, live, with_camera

System = Callable[[], tuple[FakeConsole, FakeLauncher]]
STATES: list[tuple[str, System, tuple[int, int]]] = [
    ("empty", empty, (80, 24)),
    ("live", live, (80, 24)),
    ("faulty", faulty, (80, 24)),
    ("narrow", live, (60, 20)),
]
PICTURED = {
    "live": ("parameters", "graph", "plot", "steering", "launch", "topics", "history", "diagnostics", "images"),
    "empty": ("parameters",),
    "faulty": ("alarms",),
    "narrow": ("parameters",),
}
"""The panes whose picture in that state the default run compares; the overview and the questions show the others."""
RARER: list[tuple[str, System, tuple[int, int]]] = [
    ("medium", live, (120, 40)),
    ("large", live, (200, 50)),
    ("empty_medium", empty, (120, 40)),
    ("faulty_medium", faulty, (120, 40)),
    ("fleet_medium", fleet, (120, 40)),
    ("empty_large", empty, (200, 50)),
    ("fleet_large", fleet, (200, 50)),
    ("faulty_large", faulty, (200, 50)),
]
"""Pictures of the same code with more room."""


def app_of(system: System, start: str = "overview") -> BotConsoleApp:
    console, console.launcher = system()
    return BotConsoleApp(console, refresh_hz=0, opening=Opening(start))


def marks(state: str, pane: str) -> list[pytest.MarkDecorator]:
    """The marks that keep the picture of a pane out of the default run."""
    if state in [each[0] for each in RARER]:
        return [pytest.mark.soak]
    return [] if pane in PICTURED[state] else [pytest.mark.slow]


@pytest.mark.parametrize(
    ("entry", "state", "system", "size"),
    [pytest.param(entry, *each, id=f"{entry.id}-{each[0]}", marks=marks(each[0], entry.id))
     for entry in PANES for each in (*STATES, *RARER)],
)  # fmt: skip
def test_pane(entry: Any, state: str, system: System, size: tuple[int, int], snap_compare: Any) -> None:
    assert snap_compare(app_of(system), terminal_size=size, press=[entry.key])


@pytest.mark.parametrize(
    "size",
    [
        pytest.param((60, 20), id="least"),
        pytest.param((80, 24), id="compact", marks=pytest.mark.slow),
        pytest.param((100, 30), id="small", marks=pytest.mark.slow),
        pytest.param((120, 40), id="medium", marks=pytest.mark.slow),
        pytest.param((200, 50), id="large", marks=pytest.mark.slow),
    ],
)
def test_overview(size: tuple[int, int], snap_compare: Any) -> None:
    assert snap_compare(app_of(live), terminal_size=size)


FOLDED = {"graph": [], "launch": [pytest.mark.slow], "topics": [pytest.mark.slow]}
"""The panes that fold a fleet; their pictures at the smallest size are compared before each change."""


@pytest.mark.parametrize(
    "entry",
    [pytest.param(each, id=each.id, marks=FOLDED.get(each.id, [pytest.mark.soak])) for each in PANES],
)
def test_fleet(entry: Any, snap_compare: Any) -> None:
    assert snap_compare(app_of(fleet), terminal_size=(80, 24), press=[entry.key])


@pytest.mark.soak
@pytest.mark.parametrize("size", [(80, 24), (120, 40), (200, 50)], ids=["compact", "medium", "large"])
@pytest.mark.parametrize("system", [empty, fleet])
def test_overview_of_other_systems(system: System, size: tuple[int, int], snap_compare: Any) -> None:
    assert snap_compare(app_of(system), terminal_size=size)


def test_too_small(snap_compare: Any) -> None:
    assert snap_compare(app_of(live), terminal_size=(50, 15))


LONG_AND_SHORT = {"parameters": [pytest.mark.slow], "world": []}
"""The panes whose help is compared before each change; pilot tests check that each help names all keys."""


@pytest.mark.parametrize(
    "entry",
    [pytest.param(each, id=each.id, marks=LONG_AND_SHORT.get(each.id, [pytest.mark.soak])) for each in PANES],
)
def test_help(entry: Any, snap_compare: Any) -> None:
    assert snap_compare(app_of(live), terminal_size=(100, 40), press=[entry.key, "question_mark"])


OVERLAYS = {
    "graph_node": ["3", "enter"],
    "graph_filtered": ["3", "slash", "s", "a", "f", "e", "enter"],
    "plot_strips": ["4", "f"],
    "plot_add": ["4", "a"],
    "parameter_edit": ["1", "e"],
    "parameter_refused": ["1", "e", "9", "9", "9", "enter"],
    "log_message": ["2", "enter"],
    "profile_differences": ["7", "down"],
    "profile_question": ["7", "down", "a"],
    "profile_applied": ["7", "down", "a", "y"],
    "launch_picker": ["8", "o"],
    "launch_arguments": ["8", "o", "enter"],
    "launch_kill": ["8", "down", "K"],
    "launch_process": ["8", "down", "down", "down", "down", "enter"],
    "all_stop": ["exclamation_mark"],
}


BY_DEFAULT = ("parameter_refused", "launch_picker", "profile_question", "all_stop")
"""One picture of each kind: a field with an error, a list to choose from, a question, a stop."""


@pytest.mark.parametrize(
    "keys",
    [
        pytest.param(keys, id=name, marks=() if name in BY_DEFAULT else pytest.mark.slow)
        for name, keys in OVERLAYS.items()
    ],
)
def test_in_use(keys: list[str], snap_compare: Any) -> None:
    async def use(pilot: Any) -> None:
        await pilot.press(*keys)
        await pilot.app.workers.wait_for_complete()  # what is completed or read beside
        await pilot.pause()

    assert snap_compare(app_of(live), terminal_size=(100, 30), run_before=use)


@pytest.mark.parametrize(
    "size",
    [pytest.param((80, 24), id="small"), pytest.param((120, 40), id="medium", marks=pytest.mark.soak)],
)
def test_steering_armed(size: tuple[int, int], snap_compare: Any) -> None:
    async def steer(pilot: Any) -> None:
        pilot.app.query_one(SteeringPane).clock = Clock()
        await pilot.press("6", "enter", "w", "W", "a", "a", "a")

    assert snap_compare(app_of(live), terminal_size=size, run_before=steer)


@pytest.mark.parametrize(
    "keys", [pytest.param(["I"], id="colours", marks=pytest.mark.slow), pytest.param(["I", "g"], id="letters")]
)
def test_image(keys: list[str], snap_compare: Any) -> None:
    assert snap_compare(app_of(lambda: with_camera("front")), terminal_size=(80, 24), press=keys)
