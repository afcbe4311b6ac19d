"""No text of the system reaches the terminal as a control character, whatever field carries it.

The fields are not listed: every string of every model that the console passes to the panes gets the hostile text, and
every key of every pane is pressed.
"""

from __future__ import annotations

import dataclasses
import unicodedata
from collections.abc import Mapping
from enum import Enum
from types import MappingProxyType
from typing import Any

import pytest
from bot_console.tui.keymap import TABLE
from bot_console.tui.pane_table import PANES
from bot_console.tui.terminal.cells import cells_of
from fakes.console import FakeConsole
from piloting import Session, run
from rich.color import ColorSystem
from samples import BELL, live, with_camera

ACTING_CATEGORIES = ("Cc", "Cf", "Co", "Cn", "Cs")
"""Categories of characters that a terminal may obey, or that cannot be encoded."""
LEAVING = {"logs.edit"}
"""Keys that leave the terminal to another program."""


def hostile_everywhere(value: Any, *, fill: bool) -> Any:
    """A copy of a model with `BELL` at the end of each string; of empty ones, too, if `fill`."""
    if isinstance(value, Enum):
        return value
    if isinstance(value, str):
        return value + BELL if value or fill else value
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        fields = {each.name: getattr(value, each.name) for each in dataclasses.fields(value) if each.init}
        return dataclasses.replace(
            value, **{name: hostile_everywhere(each, fill=fill) for name, each in fields.items()}
        )
    if isinstance(value, Mapping):
        return MappingProxyType(
            {hostile_everywhere(key, fill=fill): hostile_everywhere(each, fill=fill) for key, each in value.items()}
        )
    if isinstance(value, tuple) and hasattr(value, "_fields"):
        return type(value)(*(hostile_everywhere(each, fill=fill) for each in value))
    if isinstance(value, (tuple, list, set, frozenset)):
        return type(value)(hostile_everywhere(each, fill=fill) for each in value)
    return value


def make_hostile(console: FakeConsole, *, fill: bool) -> None:
    """Put the hostile text into everything that a console passes to the panes."""
    now = console.current
    console.change(
        **{
            each.name: hostile_everywhere(getattr(now, each.name), fill=fill)
            for each in dataclasses.fields(now)
            if each.name not in ("seq", "stamp", *(("capabilities", "problem") if fill else ()))
        }
    )
    console.journal = hostile_everywhere(console.journal, fill=fill)
    console.sensors.info = hostile_everywhere(console.sensors.info, fill=fill)
    console.differences.update(hostile_everywhere(dict(console.differences), fill=fill))


def acting_characters(session: Session) -> list[str]:
    """The characters of the whole screen that would act on a terminal if they were written."""
    found: list[str] = []
    for strip in session.app.screen._compositor.render_strips():
        written = "".join(cells_of(strip, ColorSystem.TRUECOLOR).characters)
        if any(unicodedata.category(each) in ACTING_CATEGORIES for each in written):
            found.append(written)
    return found


@pytest.mark.soak
@pytest.mark.parametrize(
    ("system", "fill"),
    [
        (live, False),
        (live, True),
        (lambda: with_camera("front"), False),
    ],
)
def test_no_field_of_any_model_reaches_the_terminal_as_control_characters(system: Any, fill: bool) -> None:
    made = system()
    make_hostile(made[0], fill=fill)

    async def play(session: Session) -> None:
        seen = False
        for entry in PANES:
            pane = None
            for key in TABLE.get(entry.id, ()):
                if key.action in LEAVING:
                    continue
                if session.app.screen.focused is not pane:  # the previous key has opened something
                    await session.press("escape", "escape", entry.key)
                    pane = session.app.screen.focused
                await session.press(key.keys.split(",")[0])
                assert acting_characters(session) == [], (entry.id, key)
                seen = seen or "evil[red]" in session.text()
        assert seen

    run(made, play, (120, 40))
