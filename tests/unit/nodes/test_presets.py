"""Presets as a service: saved, listed, applied all or nothing, deleted; the modes of the course page's robot."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import rclpy
from bot_console_robot.preset_files import PresetError, read, write
from diagnostic_msgs.srv import AddDiagnostics
from rcl_interfaces.msg import SetParametersResult
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from rclpy.parameter_client import AsyncParameterClient
from std_srvs.srv import Trigger

DOMAINS = itertools.count(8200)
TIMEOUT_S = 240.0
MODES = {"normal": (1.0, 50), "aggressive": (3.0, 30), "cautious": (0.5, 80), "eco": (0.8, 60)}


class Bench:
    """A robot with modes, an arm, the preset node, and a client of it."""

    def __init__(self, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        from bot_console_robot.preset_node import Presets

        domain = next(DOMAINS)
        monkeypatch.setenv("ROS_DOMAIN_ID", str(domain))
        monkeypatch.setenv("BOT_CONSOLE_USER_DIR", str(folder))
        rclpy.init(args=[])
        self.robot = rclpy.create_node("dynamic_robot")
        self.robot.declare_parameter("speed", 1.0)
        self.robot.declare_parameter("sensitivity", 50)
        self.robot.add_on_set_parameters_callback(self._rule)
        self.arm = rclpy.create_node("arm")
        self.arm.declare_parameter("reach", [1.0, 2.0])
        self.presets = Presets()
        self.client = rclpy.create_node("client")
        self.executor = SingleThreadedExecutor()
        for node in (self.robot, self.arm, self.presets, self.client):
            self.executor.add_node(node)

    def _rule(self, parameters: list[Parameter]) -> SetParametersResult:
        fast = any(each.name == "speed" and each.value > 5.0 for each in parameters)
        return SetParametersResult(successful=not fast, reason="Speed must be between 0.0 and 5.0" if fast else "")

    def ask(self, verb: str, name: str = "") -> tuple[bool, str]:
        kind: Any = Trigger if verb == "list" else AddDiagnostics
        client = self.client.create_client(kind, f"/presets/{verb}")
        request = kind.Request()
        if name:
            request.load_namespace = name
        future = client.call_async(request)
        self.executor.spin_until_future_complete(future, TIMEOUT_S)
        answer = future.result()
        assert answer is not None
        return answer.success, answer.message

    def speed(self) -> tuple[object, object]:
        return self.robot.get_parameter("speed").value, self.robot.get_parameter("sensitivity").value

    def close(self) -> None:
        for node in (self.robot, self.arm, self.presets, self.client):
            node.destroy_node()
        self.executor.shutdown()
        rclpy.shutdown()


@pytest.fixture
def bench(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Bench]:
    made = Bench(tmp_path, monkeypatch)
    yield made
    made.close()


def test_modes_of_the_course_robot_are_presets(bench: Bench) -> None:
    for name, (speed, sensitivity) in MODES.items():
        bench.robot.set_parameters([Parameter("speed", value=speed), Parameter("sensitivity", value=sensitivity)])
        done, text = bench.ask("save", name)
        assert done and "saved" in text
    assert bench.ask("list") == (True, "aggressive\ncautious\neco\nnormal")
    for name, values in MODES.items():
        done, text = bench.ask("apply", name)
        assert done and f"preset {name}" in text
        assert bench.speed() == values
    assert bench.ask("delete", "eco")[0]
    assert "eco" not in bench.ask("list")[1]
    assert bench.ask("apply", "eco") == (False, "there is no preset 'eco'; there are: aggressive, cautious, normal")


def test_refusal_by_one_node_changes_no_node(bench: Bench, tmp_path: Path) -> None:
    folder = tmp_path / "config" / "profiles"
    write(folder, "wild", {"/arm": {"reach": [9.0]}, "/dynamic_robot": {"speed": 9.0}})
    done, text = bench.ask("apply", "wild")
    assert not done and "nothing was set: /dynamic_robot refused: Speed must be" in text
    assert list(bench.arm.get_parameter("reach").value) == [1.0, 2.0]
    write(folder, "wild", {"/arm": {"reach": [9.0]}, "/gone": {"speed": 9.0}})
    assert "/gone is not running" in bench.ask("apply", "wild")[1]
    write(folder, "wild", {"/arm": {"reach": [9.0], "length": 1}})
    assert "/arm has no parameter length" in bench.ask("apply", "wild")[1]
    assert list(bench.arm.get_parameter("reach").value) == [1.0, 2.0]


def test_client_gets_time_to_discover_the_services(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    polls = itertools.count()
    monkeypatch.setattr(AsyncParameterClient, "services_are_ready", lambda client: next(polls) > 2)
    assert bench.ask("save", "normal")[0] and next(polls) > 4


@pytest.mark.parametrize("name", ["", "../x", "a/b", ".hidden"])
def test_preset_name_cannot_leave_the_folder(bench: Bench, name: str) -> None:
    if name:
        assert not bench.ask("save", name)[0]
    with pytest.raises(PresetError, match="not a valid preset name"):
        read(Path("/tmp"), name)


@pytest.mark.parametrize("value", ["!!int", "!!timestamp x", "&a {b: *a}"])
def test_invalid_preset_file_is_reported(tmp_path: Path, value: str) -> None:
    (tmp_path / "odd.yaml").write_text(f"/arm: {{ros__parameters: {{reach: {value}}}}}")
    with pytest.raises(PresetError, match="cannot be read"):
        read(tmp_path, "odd")
