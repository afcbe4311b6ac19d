"""The tree of the diagnostics pane: names split at slashes, each with the worst level below it. Pure."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, field

from bot_console.tui.console.filter_syntax import Query
from bot_console.tui.console.sensors.diagnostic_status import Level, Status


@dataclass(frozen=True, slots=True)
class Row:
    """A part of the robot: one with a status, one with parts below it, or both."""

    path: str
    title: str
    depth: int
    level: Level
    status: Status | None = field(default=None, compare=False)
    message: str = ""
    age: int = 0
    """Whole seconds since its status arrived; without one, since the oldest status below it arrived."""
    count: int = 0
    """Number of statuses below it."""
    bad: int = 0
    """Number of statuses below it that are not OK."""
    folded: bool = False


@dataclass(slots=True)
class _Part:
    title: str
    status: Status | None = None
    parts: dict[str, _Part] = field(default_factory=dict[str, "_Part"])

    def statuses(self) -> list[Status]:
        """The statuses of the part and of those below it."""
        below = [each for part in self.parts.values() for each in part.statuses()]
        return [self.status, *below] if self.status else below


def matches(status: Status, query: Query) -> bool:
    """Whether a status passes a filter, by its name, level, message and hardware."""
    return query.matches(f"{status.name} {status.level.name} {status.message} {status.hardware}")


def rows(statuses: Sequence[Status], now: float, folded: Collection[str] = (), *, bad_only: bool = False) -> list[Row]:
    """The tree at a time (s of the monotonic clock), sorted by name; `bad_only` leaves out statuses that are OK."""
    top = _Part("")
    for status in statuses:
        if bad_only and status.now(now) is Level.OK:
            continue
        part = top
        for title in [each for each in status.name.split("/") if each] or [status.name]:
            part = part.parts.setdefault(title, _Part(title))
        part.status = status
    found: list[Row] = []
    _add(found, top, "", 0, now, folded)
    return found


def _add(found: list[Row], above: _Part, path: str, depth: int, now: float, folded: Collection[str]) -> None:
    for title in sorted(above.parts, key=str.lower):
        part = above.parts[title]
        own = f"{path}/{title}"
        every = part.statuses()
        below = every[1:] if part.status else every
        level = max((each.now(now) for each in every), key=lambda each: each.weight)
        bad = sum(each.now(now) is not Level.OK for each in below)
        age = now - (part.status.last_received if part.status else min(each.last_received for each in every))
        closed = bool(part.parts) and own in folded
        message = part.status.message if part.status else ""
        found.append(Row(own, title, depth, level, part.status, message, max(0, int(age)), len(below), bad, closed))
        if not closed:
            _add(found, part, own, depth + 1, now, folded)
