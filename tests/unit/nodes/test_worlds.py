"""Worlds by name, where there is none of that name."""

import pytest
from bot_console_robot.simulation.world import WorldError
from bot_console_robot.simulator.worlds import find_world


@pytest.mark.parametrize("name", ["nowhere", "a" * 300], ids=["unknown", "too long for a file"])
def test_the_worlds_that_there_are_are_named(name: str) -> None:
    with pytest.raises(WorldError, match=r"no world .* there are: .*warehouse"):
        find_world(name)
