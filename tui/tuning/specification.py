"""The specification of a tuning: tunables, score, worlds, seeds, budget. Equal specifications have equal results."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any

from bot_console.tui.tuning.score import Score
from bot_console.tui.tuning.tunable import Setting, Tunable

HELD_OUT = 1_000
"""Added to the seed for held-out runs, which evaluate the result: no setting is chosen by them."""


@dataclass(frozen=True)
class Trial:
    """One run: a setting in a world from a seed."""

    setting: Setting
    world: str
    """The name of the world; empty: the profile's."""
    seed: int

    @property
    def key(self) -> str:
        """The run's key in the journal."""
        return json.dumps([list(self.setting), self.world, self.seed])


@dataclass(frozen=True)
class TuningSpecification:
    """What a tuning job varies and scores, and the runs that it makes."""

    tunables: tuple[Tunable, ...]
    score: Score
    profile: str = "indoor"
    """The name of a profile, or the path of a parameter file."""
    worlds: tuple[str, ...] = ("",)
    runs: int = 60
    """The total number of simulator runs, without those on held-out seeds."""
    seeds: int = 3
    """The number of seeds for each setting, in each world."""
    held_out: int = 5
    """The number of further seeds, on which the best setting is compared with the initial one at the end."""
    seed: int = 1
    """The first seed of the simulator, and the seed of the search."""
    duration: float = 60.0
    """Simulated seconds of each run."""
    search: str = "adaptive"
    arguments: Mapping[str, str] = field(default_factory=dict[str, str])
    """Launch arguments."""
    base: Mapping[str, Mapping[str, Any]] = field(default_factory=dict[str, Mapping[str, Any]])
    """Values of a running system, by node and name, that override the profile's."""

    @property
    def settings(self) -> int:
        """How many settings the budget of runs allows."""
        return max(1, self.runs // (self.seeds * len(self.worlds)))

    def trials(self, setting: Setting) -> list[Trial]:
        """The runs that evaluate a setting."""
        return [Trial(setting, world, self.seed + n) for world in self.worlds for n in range(self.seeds)]

    def held_out_trials(self, setting: Setting) -> list[Trial]:
        """The runs that evaluate the result, on seeds that were not used to choose a setting."""
        first = self.seed + HELD_OUT
        return [Trial(setting, world, first + n) for world in self.worlds for n in range(self.held_out)]

    def values(self, setting: Setting) -> dict[str, dict[str, Any]]:
        """All values of a run, by node and name."""
        values = {node: dict(found) for node, found in self.base.items()}
        for tunable, value in zip(self.tunables, setting, strict=True):
            values.setdefault(tunable.node, {})[tunable.name] = value
        return values

    @property
    def digest(self) -> str:
        """An id of everything a run's report depends on, and of the order of the runs."""
        fields = asdict(self)
        fields["dials"] = fields.pop("tunables")  # the name in earlier releases, so that their journals are still found
        text = json.dumps(fields, sort_keys=True, default=str)
        return hashlib.blake2b(text.encode(), digest_size=8).hexdigest()

    def problem(self) -> str:
        """What is wrong with the numbers; empty if nothing is."""
        if self.seeds < 1 or self.held_out < 0 or not self.duration > 0:
            return "seeds and duration must be positive"
        per = self.seeds * len(self.worlds)
        if self.runs < 2 * per:
            each = f"{self.seeds} seeds" + (f" in {len(self.worlds)} worlds" if len(self.worlds) > 1 else "")
            return f"{self.runs} runs are too few: with {each} each setting takes {per}; give at least {2 * per}"
        return ""
