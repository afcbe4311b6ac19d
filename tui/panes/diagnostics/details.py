"""Everything known about one status, as lines. Pure."""

from __future__ import annotations

from bot_console.tui.console.sensors.model import Level, Status
from bot_console.tui.format import clock_text, counted
from bot_console.tui.panes.diagnostics.table import LEVEL_STYLES
from bot_console.tui.panes.diagnostics.tree import Row
from bot_console.tui.screens.facts import Section
from rich.cells import cell_len


def sections(status: Status, now: float) -> list[Section]:
    """The message of a status, its values, and its history, newest first."""
    level, age = status.now(now), int(now - status.heard)
    head = [f"{LEVEL_STYLES[level][0]} {level.name}  {status.message}"]
    if level is Level.STALE and status.level is not level:
        head.append(f"silent for {counted(age, 'second')}; it was {status.level.name}")
    if status.hardware:
        head.append(f"hardware {status.hardware}")
    wide = max((cell_len(key) for key, _ in status.values), default=0)
    values = [f"{key}{' ' * (wide - cell_len(key))}  {value}" for key, value in status.values]
    reported = [
        f"{clock_text(each.stamp)[:8]}  {each.level.name:<5}  {each.message}" for each in reversed(status.history)
    ]
    return [(status.name, head), ("values", values), ("was", reported)]


def below_text(row: Row) -> str:
    """The details of a part that only contains others."""
    return f"{row.path}\n  {row.count - row.bad} of {row.count} OK"
