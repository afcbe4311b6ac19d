"""Runs in separate processes: the report equals that of the same headless run; a refused value is a failed run."""

from __future__ import annotations

import json
import os
from collections.abc import Generator

import pytest
from bot_console.tui.cli.main import main
from bot_console.tui.cli.tune.pool import CAN_FORK, Pool, profile_yaml
from bot_console.tui.cli.tune.results import tunables_of
from bot_console.tui.tuning.score import parse_score
from bot_console.tui.tuning.specification import Trial, TuningSpecification

pytestmark = pytest.mark.skipif(not CAN_FORK, reason="this system cannot fork processes")
SPEED = "/odom/twist.twist.linear.x"


@pytest.fixture(scope="module")
def pool() -> Generator[Pool]:
    made = Pool(2)
    yield made
    made.close()


def test_run_reports_the_same_as_headless(pool: Pool, capsys: pytest.CaptureFixture[str]) -> None:
    specification = TuningSpecification((), parse_score(f"greatest({SPEED})"), profile="outdoor", duration=2.0)
    begun = [pool.begin(specification, Trial((), "", seed)) for seed in (3, 4)]
    assert main(["--headless", "--fast", "--profile", "outdoor", "--duration", "2", "--seed", "3"]) == 0
    expected = json.loads(capsys.readouterr().out)
    first, second = (each.result() for each in begun)
    assert first["digest"] == expected["digest"] != second["digest"]
    assert first["deterministic"]
    assert 0.1 < specification.score.of(first) == first["topics"][SPEED]["greatest"] < 3.0


def test_refused_value_fails_the_run_with_its_reason(pool: Pool) -> None:
    specification = TuningSpecification(
        (), parse_score("swift"), duration=2.0, base={"/safety_monitor": {"warning_distance": 0.2}}
    )
    problem = pool.begin(specification, Trial((), "", 1)).result()["problem"]
    assert "safety_node" in problem
    assert "warning_distance (0.2 m) must be greater than" in problem


def test_probe_finds_tunables_with_ranges_and_values(pool: Pool) -> None:
    known = {each.label: each for each in tunables_of(pool.probe("outdoor", {}).result())}
    speed = known["/robot_navigator:max_speed"]
    assert (speed.kind, speed.low, speed.high, speed.now, speed.unit) == ("double", 0.1, 5.0, 2.0, "m/s")
    assert known["/robot_navigator:enable_safety"].kind == "bool"
    assert known["/robot_navigator:detection_threshold"].kind == "integer"
    assert not any(label.endswith((":robot_name", ":use_sim_time")) for label in known)


def test_closing_leaves_no_process(pool: Pool) -> None:
    short = Pool(1)
    begun = short.begin(TuningSpecification((), parse_score("swift"), duration=100_000.0), Trial((), "", 1))
    server = short.server_pid
    short.close()
    assert begun.cancelled() or begun.exception() or begun.result().get("problem")
    with pytest.raises(ProcessLookupError):
        os.kill(server, 0)


def test_profile_text_is_found_by_name_or_path(tmp_path) -> None:
    own = tmp_path / "mine.yaml"
    own.write_text("/a: {ros__parameters: {b: 1}}\n")
    assert profile_yaml(str(own)).startswith("/a")
    assert "IndoorBot" in profile_yaml("indoor")
    with pytest.raises(OSError, match="nowhere"):
        profile_yaml("nowhere")
