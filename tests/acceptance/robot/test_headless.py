"""Headless runs are reproducible bit for bit, and say clearly what they cannot do."""

import json
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from bot_console.runtime.workspace.builtin_package import ROOT
from bot_console.tui.cli.main import main
from processes.command_line import run_cli
from systems import system

sys.path.insert(0, str(Path(__file__).parent))
from headless import TIMEOUT_S, headless


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """Two runs with one seed, and one with another."""
    folder = tmp_path_factory.mktemp("runs")
    return [headless(folder, "--duration", "12", "--seed", seed) for seed in ("5", "5", "6")]


def test_same_seed_gives_same_digest(runs):
    assert runs[0]["digest"] == runs[1]["digest"]
    assert runs[0]["deterministic"] and runs[1]["deterministic"]


def test_another_seed_gives_another_digest(runs):
    assert runs[0]["digest"] != runs[2]["digest"]


def test_whole_report_is_reproducible(runs):
    first, second = ({key: value for key, value in run.items() if key not in ("log", "wall_time")} for run in runs[:2])
    assert first == second


def test_report_contains_the_options(runs):
    report = runs[0]
    assert (report["world"], report["seed"], report["duration"]) == ("indoor", 5, 12.0)
    assert report["distance"] > 2.0
    assert report["mean_speed"] == pytest.approx(report["distance"] / 12.0, rel=1e-3)
    assert report["messages"] > 400
    assert report["timer_lateness_ms"]["max"] == 0.0
    assert set(report) >= {"min_clearance", "stops", "collisions"}


def test_profile_of_a_folder_is_run_by_name(tmp_path):
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "crate.yaml").write_text("simulator:\n  ros__parameters:\n    world: warehouse\n")
    report = headless(tmp_path, "--profiles", "mine", "--profile", "crate", "--duration", "1")
    assert report["world"] == "warehouse"


def test_logs_are_formatted_as_in_ros(runs):
    assert "[simulator_node-1] [INFO] [1700000000.000000000] [simulator]: Office" in runs[0]["log"]


@pytest.mark.slow
def test_real_time_run_is_reported_as_not_deterministic(tmp_path):
    done = run_cli("--headless", "--duration", "1", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert '"deterministic": false' in done.stdout


@pytest.mark.skipif(sys.platform == "win32", reason="needs POSIX signals")
@pytest.mark.parametrize(
    ("fast", "name"),
    [
        pytest.param(["--fast"], "SIGINT", marks=pytest.mark.slow),
        pytest.param(["--fast"], "SIGHUP", marks=pytest.mark.soak),
        ([], "SIGTERM"),
    ],
    ids=["fast, interrupted", "fast, hung up", "real time, terminated"],
)
def test_run_ended_early_still_reports(tmp_path, fast, name):
    words = [sys.executable, "-m", "bot_console.tui", "--headless", *fast, "--duration", "1e6"]
    with subprocess.Popen(words, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as run:
        try:
            message = ""
            while "Office" not in message:
                message = run.stderr.readline()
                assert message, "the simulator has not come up"
            run.send_signal(signal.Signals[name])
            out, err = run.communicate(timeout=TIMEOUT_S)
        finally:
            run.kill()
    assert run.returncode == 0, err
    assert json.loads(out)["duration"] < 1e6
    assert "Traceback" not in err


ENDING = """from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription, Shutdown, TimerAction

def generate_launch_description():
    robot = IncludeLaunchDescription({file!r})
    return LaunchDescription([robot, TimerAction(period={seconds!r}, actions=[Shutdown()])])
"""


def test_launch_that_ends_by_itself_is_reported_up_to_its_end(tmp_path):
    text = ENDING.format(file=str(ROOT / "launch" / "simulator.launch.py"), seconds=3.0)
    (tmp_path / "ending.launch.py").write_text(text)
    report = headless(tmp_path, "--duration", "1000", "--launch", "ending.launch.py")
    assert report["duration"] == pytest.approx(3.0, abs=0.05)
    assert report["deterministic"]


NEVER_ENDS = """
import signal
import threading
import time


def work():
    while True:
        time.sleep(0.5)


threading.Thread(target=work).start()
signal.signal(signal.SIGTERM, lambda number, frame: None)
try:
    time.sleep(1000.0)
except KeyboardInterrupt:
    pass  # and its thread goes on
"""
STARTS_IT = """
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([Node(executable={program!r})])
"""


def test_program_that_never_ends_is_killed_by_its_launch(tmp_path):
    program = tmp_path / "never_ends.py"
    program.write_text(NEVER_ENDS)
    (tmp_path / "starts_it.launch.py").write_text(STARTS_IT.format(program=str(program)))
    report = headless(tmp_path, "--duration", "2", "--simulator", "--launch", "starts_it.launch.py")
    assert "[never_ends.py-1]: process has died" in report["log"]
    assert "exit code -9" in report["log"]


@pytest.mark.slow
def test_run_whose_navigator_has_died_reports_it_and_fails(tmp_path):
    (tmp_path / "dies.py").write_text("raise SystemExit(3)\n")
    done = run_cli("navigator:=dies.py", "--headless", "--fast", "--duration", "2", cwd=tmp_path)
    assert done.returncode == 1 and json.loads(done.stdout)["distance"] == 0.0
    assert done.stderr.splitlines()[-1].startswith("dies.py-6 ended with exit code 3, so the report")


@pytest.mark.parametrize("content", ["simulator:\n  ros__parameters:\n    world: 5\n", "a: [\n"], ids=["value", "YAML"])
def test_parameters_that_end_the_simulator_end_the_run_at_once(tmp_path, content):
    (tmp_path / "bad.yaml").write_text(content)
    done = run_cli("--headless", "--fast", "--duration", "1000", "config_file:=bad.yaml", cwd=tmp_path)
    assert done.returncode == 1
    assert "the simulator ended with exit code 1 before it reported" in done.stderr.splitlines()[-1]
    assert "[1700000001." not in done.stderr, "no second was simulated after that"


@pytest.mark.parametrize(
    ("words", "code", "text"),
    [
        (["--headless", "nowhere"], 2, "there is no profile and no command 'nowhere'"),
        (["--headless", "pkg", "node"], 2, "runs with `bot-console run --headless pkg node`"),
        (["--headless", "--launch", "missing.launch.py"], 1, "there is no launch file missing.launch.py"),
        (["--headless", "--launch", "turtlesim", "no.launch.py"], 1, "file 'no.launch.py' was not found in the share"),
        (["--fast"], 2, "--fast needs --headless"),
        (["--headless", "--duration", "-1"], 2, "--duration: must be positive"),
        (["--headless", "--duration", "inf"], 2, "--duration: must be positive"),
        (["--headless", "--seed", "-1"], 2, "--seed: must be from 0 to 9223372036854775807"),
        (["run", "--headless", "--seed", str(2**63), "x.py"], 2, "--seed: must be from 0 to 9223372036854775807"),
    ],
)
def test_wrong_usage_gets_one_clear_line(tmp_path, monkeypatch, capfd, words, code, text):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit) as end:
        sys.exit(main(words))
    assert end.value.code == code
    reported = capfd.readouterr().err
    assert text in reported and "Traceback" not in reported


def test_unknown_world_ends_the_run(tmp_path):
    done = run_cli("--headless", "--fast", "--duration", "1", "world:=nowhere", cwd=tmp_path)
    assert done.returncode == 1, done.stderr
    assert "no world 'nowhere'" in done.stderr
    assert "Traceback" not in done.stderr


WATCHED = """
import atexit, gc, json, sys
from bot_console.tui.cli.main import program
atexit.register(lambda: print(json.dumps(
    [gc.isenabled(), gc.get_freeze_count(), sorted(each for each in sys.modules if ".plot" in each)]
)))
program()
"""


@pytest.mark.slow
def test_garbage_is_collected_once_nodes_are_up_and_no_plots_are_imported(tmp_path):
    words = ("--headless", "--fast", "--duration", "1")
    run = [sys.executable, "-c", WATCHED, *words]
    done = subprocess.run(run, cwd=tmp_path, capture_output=True, text=True, timeout=TIMEOUT_S, check=True)
    collects, frozen, plots = json.loads(done.stdout.splitlines()[-1])
    assert collects and frozen > 10_000
    assert plots == []


DRAWS = """
import random
import numpy as np
import rclpy

rclpy.init()
node = rclpy.create_node("draws")
print("DRAWN", random.random(), np.random.rand(), flush=True)
rclpy.spin_once(node, timeout_sec=0.1)
"""


def test_random_numbers_of_a_program_are_those_of_the_seed():
    def drawn():
        with system() as running:
            return running.finish(running.python("-c", DRAWS)).stdout

    first = drawn()
    assert first.startswith("DRAWN") and first == drawn()


@pytest.mark.slow
def test_random_numbers_of_a_node_are_reproducible(tmp_path):
    (tmp_path / "draws.py").write_text(DRAWS)

    def drawn(seed: str) -> list[str]:
        words = ("run", "--headless", "--fast", "--no-simulator", "--duration", "1", "--seed", seed, "draws.py")
        done = run_cli(*words, cwd=tmp_path)
        return [line for line in done.stderr.splitlines() if "DRAWN" in line]

    first = drawn("3")
    assert len(first) == 1 and first == drawn("3")
    assert first != drawn("4")
