"""An alarm: a named condition, the samples that decide it, and every time it became active. No widgets."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, cast

from bot_console.tui.console.plot.port import Plots, Samples
from bot_console.tui.panes.alarms.condition import Condition, parse_condition

MAX_SAMPLES = 50
"""Maximum number of samples of one path that are processed per poll; older ones are skipped."""


@dataclass(frozen=True)
class AlarmText:
    """An alarm as typed by the user; kept from run to run."""

    name: str
    condition: str
    bell: bool = False

    @property
    def data(self) -> dict[str, object]:
        """The alarm as plain data, for a file."""
        return {"name": self.name, "condition": self.condition, **({"bell": True} if self.bell else {})}


def alarm_texts_in(data: object) -> list[AlarmText]:
    """The alarms in a file's data, without invalid entries and conditions."""
    found: list[AlarmText] = []
    for each in cast("list[object]", data) if isinstance(data, list) else []:
        given = cast("Mapping[str, Any]", each) if isinstance(each, Mapping) else dict[str, Any]()
        name, condition = given.get("name"), given.get("condition")
        if isinstance(name, str) and isinstance(condition, str):
            try:
                parse_condition(condition)
            except ValueError:
                continue
            found.append(AlarmText(name, condition, given.get("bell") is True))
    return found


@dataclass
class Alarm:
    """An alarm: tracks whether its condition holds as samples arrive."""

    text: AlarmText
    condition: Condition
    holds: bool | None = None
    """Whether the condition holds; None while a value is missing or the condition cannot be evaluated."""
    since: float = 0.0
    """When `holds` last changed, in s on the time axis of all series."""
    times: int = 0
    """How often the condition has become true."""
    values: dict[str, float] = field(default_factory=dict[str, float])
    problem: str = ""
    unreported: list[float] = field(default_factory=list[float])
    """The values at which the condition became true since the last notice."""
    reported: float = float("-inf")
    """The time of the last notice, in s of the pane's clock."""
    _cursors: dict[str, int] = field(default_factory=dict[str, int])

    @classmethod
    def of(cls, text: AlarmText) -> Alarm:
        """An alarm without samples; raises `ValueError` for an invalid condition."""
        return cls(text, parse_condition(text.condition))

    @property
    def paths(self) -> tuple[str, ...]:
        """The paths in its condition."""
        return self.condition.paths

    def poll(self, plots: Plots) -> list[float]:
        """Process new samples in order; returns the values of the first path at which the alarm became active."""
        began: list[float] = []
        for time, path, value in self._new(plots):
            self.values[path] = value
            before = self.holds
            self._judge()
            if self.holds is not before:
                self.since = time
            if self.holds and not before:
                self.times += 1
                began.append(self.values[self.paths[0]])
        return began

    def _new(self, plots: Plots) -> list[tuple[float, str, float]]:
        """New samples (time, path, value) of all paths in order of time."""
        found: list[tuple[float, str, float]] = []
        for path in self.paths:
            new: Samples = plots.samples(path, self._cursors.get(path, 0))
            self._cursors[path] = new.cursor
            self.problem = new.problem or self.problem
            first = max(0, len(new.times) - MAX_SAMPLES)
            found += [(float(new.times[at]), path, float(new.values[at])) for at in range(first, len(new.times))]
        found.sort(key=lambda each: each[0])
        return found

    def _judge(self) -> None:
        missing = [each for each in self.paths if each not in self.values]
        if missing:
            self.holds = None
            return
        try:
            self.holds = self.condition.holds(self.values)
            self.problem = ""
        except ValueError as error:
            self.holds, self.problem = None, str(error)
