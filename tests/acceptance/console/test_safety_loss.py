"""The safety monitor is killed while a person drives: the robot stops, and stands until a person releases it."""

from __future__ import annotations

import threading
from pathlib import Path

import pytest
from bot_console.tui.console.ros_console import RosConsole
from domains import unused_domain
from launcher_bench import TIMEOUT_S, Bench

ROOT = Path(__file__).resolve().parents[3]


@pytest.mark.timeout(60)
def test_robot_is_not_driven_until_its_safety_monitor_is_back_and_released(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ROS_DOMAIN_ID", str(unused_domain()))
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "log"))
    bench = Bench(tmp_path)
    console = RosConsole(launch_info=bench.launcher.info)
    console.start()
    assert console.wait_ready(TIMEOUT_S)

    def speed() -> float:
        """The robot's speed (m/s) while the person keeps requesting 0.8."""
        console.drive.move(0.8, 0.0)
        actual = console.snapshot().drive.actual
        return actual[0] if actual else 0.0

    try:
        path = str(ROOT / "launch" / "robot_system.launch.py")
        assert bench.launcher.launch(path, {"profile": "outdoor"}).result(TIMEOUT_S).ok
        bench.until(lambda: speed() > 0.1, "the robot to drive")
        key = next(each.key for each in bench.info.processes if "safety" in each.label)
        assert bench.launcher.kill(key).result(TIMEOUT_S).ok
        bench.until(lambda: speed() == 0.0, "the robot to stop")
        bench.until(lambda: bench.process("safety").restarts == 1, "launch to start it again")
        bench.until(lambda: console.snapshot().drive.topic, "the arbiter to be back")
        watched = [speed() for _ in range(50) if threading.Event().wait(0.02) is False]
        assert max(watched) == 0.0, "it stands until a person releases it"
        assert console.topics.call_service("/safety_monitor/release", "std_srvs/srv/Trigger", {}).result(TIMEOUT_S).ok
        bench.until(lambda: speed() > 0.1, "the robot to drive again")
    finally:
        console.close()
        bench.launcher.close()
