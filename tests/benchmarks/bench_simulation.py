"""CPU time of the simulation: LIDAR against one ray query per beam, steps, and a whole driving robot.

Usage: python tests/benchmarks/bench_simulation.py [--repeats 5]. Prints one JSON object; ratios are within one run.
"""

from __future__ import annotations

import argparse
import json
import math
import statistics
import time
from collections.abc import Callable
from pathlib import Path

from bot_console.runtime.importer import install

install()

import numpy as np
from bot_console_robot.simulation.geometry import Pose
from bot_console_robot.simulation.lidar import LidarSettings
from bot_console_robot.simulation.simulation import Settings, Simulation
from bot_console_robot.simulation.world_file import load_world, parse_world

WORLDS = Path(__file__).resolve().parents[2] / "profiles" / "worlds"
BUDGET = 0.15
"""Minimum CPU seconds of one measurement."""


def crowded_room(shapes: int) -> Simulation:
    """A 10 m room with `shapes` walls and pillars."""
    rng = np.random.default_rng(shapes)
    walls, circles = [], []
    for i in range(shapes - 4):
        x, y = rng.uniform(0.5, 9.5, 2)
        if math.dist((x, y), (5.0, 5.0)) < 1.2:
            continue
        if i % 2:
            circles.append({"center": [x, y], "radius": float(rng.uniform(0.05, 0.2))})
        else:
            angle, length = rng.uniform(0, math.pi), rng.uniform(0.2, 0.8)
            end = [x + length * math.cos(angle), y + length * math.sin(angle)]
            if math.dist(end, (5.0, 5.0)) > 0.5:
                walls.append({"points": [[x, y], end]})
    data = json.loads(json.dumps({"size": [10, 10], "start": [5, 5, 0.3], "walls": walls, "circles": circles}))
    lidar = LidarSettings(beams=360, field_of_view=2 * math.pi, range_max=8.0, noise=0.0, dropout=0.0)
    return Simulation(parse_world("crowd", data), 1, Settings(lidar=lidar))


def cpu(work: Callable[[], object], repeats: int) -> float:
    """Median CPU seconds of one call."""
    work()
    runs = []
    for _ in range(repeats):
        calls, start = 0, time.process_time()
        while (spent := time.process_time() - start) < BUDGET:
            work()
            calls += 1
        runs.append(spent / calls)
    return statistics.median(runs)


def lidar(shapes: int, repeats: int) -> dict[str, float]:
    """One scan of 360 beams against 360 single queries, and the largest difference in m."""
    simulation = crowded_room(shapes)
    simulation.step()
    settings, heading = simulation.lidar.settings, simulation.pose.heading
    angles = [heading + settings.first_angle + i * settings.increment for i in range(settings.beams)]

    def naive() -> list[float]:
        return [simulation.true_range(angle, settings.range_max) for angle in angles]

    difference = np.nanmax(np.abs(np.nan_to_num(simulation.scan().ranges, posinf=8.0) - np.minimum(naive(), 8.0)))
    ours, theirs = cpu(simulation.scan, repeats), cpu(naive, repeats)
    return {
        "scan_us": ours * 1e6,
        "queries_us": theirs * 1e6,
        "ratio": theirs / ours,
        "beams_per_s": settings.beams / ours,
        "largest_difference_m": float(difference),
    }


def driving(world: str, repeats: int) -> dict[str, float]:
    """Simulated seconds per CPU second: steps alone, and with scans of 360 beams at 10 Hz."""
    simulation = Simulation(load_world(WORLDS / f"{world}.yaml"), 1)
    start = Pose(simulation.pose.x, simulation.pose.y, simulation.pose.heading)

    def second(scans: int) -> None:
        for step in range(100):
            simulation.command(0.5, 0.8)
            simulation.step()
            if scans and step % 10 == 0:
                simulation.scan()

    steps = cpu(lambda: second(0), repeats)
    simulation.place(start)
    return {"steps_only": 1.0 / steps, "with_scans": 1.0 / cpu(lambda: second(10), repeats)}


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0] if __doc__ else "")
    parser.add_argument("--repeats", type=int, default=5)
    repeats = parser.parse_args().repeats
    result = {
        "lidar": {str(shapes): lidar(shapes, repeats) for shapes in (10, 50, 200)},
        "realtime_factor": {path.stem: driving(path.stem, repeats) for path in sorted(WORLDS.glob("*.yaml"))},
    }
    print(json.dumps(result, indent=2, default=float))


if __name__ == "__main__":
    main()
