from pathlib import Path

import pytest
from bot_console_robot.simulation.world import World
from bot_console_robot.simulation.world_file import load_world, parse_world

WORLDS = Path(__file__).resolve().parents[3] / "profiles" / "worlds"


@pytest.fixture(params=sorted(path.stem for path in WORLDS.glob("*.yaml")))
def shipped_world(request: pytest.FixtureRequest) -> World:
    return load_world(WORLDS / f"{request.param}.yaml")


@pytest.fixture
def room() -> World:
    """6 m by 4 m with one round pillar ahead of the start."""
    return parse_world(
        "room", {"size": [6.0, 4.0], "start": [1.0, 2.0, 0.0], "circles": [{"center": [4.0, 2.0], "radius": 0.5}]}
    )
