"""The course page's driving rule on the bare simulation: drive forward, or turn left while anything is too near."""

from __future__ import annotations

import numpy as np
from bot_console_robot.simulation.simulation import Simulation

SCAN_EVERY = 10


def drive(simulation: Simulation, seconds: float, max_speed: float, safety_distance: float, turn_rate: float) -> None:
    """Let the rule drive for some simulated seconds."""
    for step in range(round(seconds * 100)):
        simulation.step()
        if step % SCAN_EVERY == SCAN_EVERY - 1:
            ranges = simulation.scan().ranges.astype(np.float32)
            nearest = ranges[ranges > 0.0].min()
            simulation.command(*((0.0, turn_rate) if nearest < safety_distance else (max_speed, 0.0)))
