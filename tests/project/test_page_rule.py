"""The page's own navigator never gets stuck in a world that we ship."""

import math
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from bot_console_robot.simulation.geometry import Pose
from bot_console_robot.simulation.lidar import LidarSettings
from bot_console_robot.simulation.simulation import Settings, Simulation
from bot_console_robot.simulation.world import World
from bot_console_robot.simulation.world_file import load_world

sys.path.insert(0, str(Path(__file__).parent))
from page_rule import drive

PROFILES = Path(__file__).resolve().parents[2] / "profiles"
NAMES = ("indoor", "outdoor", "warehouse", "competition")


def profile(name: str) -> dict[str, Any]:
    data = yaml.safe_load((PROFILES / f"{name}.yaml").read_text(encoding="utf-8"))
    return {node: entry["ros__parameters"] for node, entry in data.items()}


def world(name: str) -> World:
    return load_world(PROFILES / "worlds" / f"{name}.yaml")


def lidar(name: str, **change: float) -> Settings:
    return Settings(lidar=LidarSettings(**{**profile(name)["simulator"]["lidar"], **change}))


OFTEN = ("warehouse", "profile", 1)
"""The case of the default run, for two minutes."""
RUNS = [(name, *how) for name in NAMES for how in (("profile", 1), ("profile", 2), ("defaults", 1))]


@pytest.mark.parametrize(
    ("name", "parameters", "seed", "minutes"),
    [(*OFTEN, 2), *(pytest.param(*each, 10, marks=pytest.mark.soak) for each in RUNS)],
)
def test_robot_never_stands_for_twenty_seconds(name: str, parameters: str, seed: int, minutes: int) -> None:
    run = Simulation(world(name), seed, lidar(name))
    own = profile(name)["robot_navigator"]
    rule = (own["max_speed"], own["safety_distance"], own["turn_rate"]) if parameters == "profile" else (1.0, 0.5, 1.0)
    drive(run, 60.0 * minutes, *rule)
    assert run.metrics.longest_standstill < 20.0
    assert run.metrics.distance > 20.0 * minutes


@pytest.mark.soak
@pytest.mark.parametrize("name", NAMES)
def test_some_heading_is_free_at_every_place(name: str) -> None:
    """A place is a trap if no half circle of the safety distance is free there: the rule would turn forever."""
    exact = lidar(name, noise=0.0, dropout=0.0, false_returns=0.0, field_of_view=2 * math.pi)
    run = Simulation(replace(world(name), movers=()), 1, exact)
    safety = profile(name)["robot_navigator"]["safety_distance"]
    width, height = run.world.size
    traps = []
    for x in np.arange(0.15, width, 0.15):
        for y in np.arange(0.15, height, 0.15):
            if run.gap_at(x, y) <= 0.02:
                continue
            run.pose = Pose(float(x), float(y), 0.0)
            near = run.scan().ranges < safety
            # Beams of a full circle twice over: the longest run without a near return must exceed half a turn.
            gaps = np.diff(np.flatnonzero(np.concatenate((near, near))))
            free = 2 * math.pi if near.sum() < 2 else gaps.max() * run.lidar.settings.increment
            if free < math.pi + 0.1 * profile(name)["robot_navigator"]["turn_rate"]:
                traps.append((round(float(x), 2), round(float(y), 2), round(float(free), 2)))
    assert not traps, traps
