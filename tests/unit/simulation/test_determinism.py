import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from bot_console_robot.simulation.simulation import Simulation
from bot_console_robot.simulation.world import World

WORLDS = Path(__file__).resolve().parents[3] / "profiles" / "worlds"
PROGRAM = """
import hashlib, sys
from bot_console.runtime.importer import install
install()
from pathlib import Path
from bot_console_robot.simulation.simulation import Simulation
from bot_console_robot.simulation.world_file import load_world
simulation = Simulation(load_world(Path(sys.argv[1])), int(sys.argv[2]))
scans = hashlib.sha256()
for i in range(1500):
    simulation.step()
    if i % 10 == 9:
        scan = simulation.scan()
        scans.update(scan.ranges.tobytes() + scan.intensities.tobytes())
        simulation.command(*((0.0, 1.0) if scan.ranges.min() < 0.5 else (1.0, 0.0)))
print(simulation.metrics.digest, scans.hexdigest(), simulation.odometry.pose)
"""


def run_in_process(world: str, seed: int, hash_seed: str) -> str:
    environment = {**os.environ, "PYTHONHASHSEED": hash_seed}
    command = [sys.executable, "-c", PROGRAM, str(WORLDS / f"{world}.yaml"), str(seed)]
    return subprocess.run(command, env=environment, check=True, capture_output=True, text=True).stdout


@pytest.mark.slow
def test_same_seed_gives_the_same_run_in_every_process() -> None:
    first = run_in_process("outdoor", 1, "1")
    assert run_in_process("outdoor", 1, "2") == first
    assert run_in_process("outdoor", 2, "1") != first


def test_report_is_json(shipped_world: World) -> None:
    simulation = Simulation(shipped_world, 3)
    simulation.step()
    report = json.loads(json.dumps(simulation.report()))
    assert report["world"] == shipped_world.name
    assert report["seed"] == 3
    assert set(report) >= {"distance", "mean_speed", "min_clearance", "stops", "collisions", "digest", "digest_version"}
