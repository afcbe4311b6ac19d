"""A name that is not a world's is refused with the available names."""

import pytest
from bot_console_robot.simulation.world import WorldError
from bot_console_robot.simulation_ros.worlds import find_world


@pytest.mark.parametrize("name", ["nowhere", "a" * 300], ids=["unknown", "too long for a file"])
def test_unknown_world_lists_the_available_ones(name: str) -> None:
    with pytest.raises(WorldError, match=r"no world .* there are: .*warehouse"):
        find_world(name)
