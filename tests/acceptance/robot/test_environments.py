"""The four environments behave as their names suggest, over several seeds: a minute of CPU time per seed."""

import re
import sys
from pathlib import Path
from statistics import mean

import pytest

sys.path.insert(0, str(Path(__file__).parent))
from headless import TIMEOUT_S, headless

PROFILES = ("indoor", "outdoor", "warehouse", "competition")
SEEDS = ("1", "2", "3")
pytestmark = [pytest.mark.soak, pytest.mark.timeout(len(PROFILES) * len(SEEDS) * TIMEOUT_S)]
GUIDE = Path(__file__).resolve().parents[3] / "docs" / "environments.md"


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """Reports of two simulated minutes, by profile, one per seed."""
    folder = tmp_path_factory.mktemp("profiles")
    return {
        name: [headless(folder, "--profile", name, "--duration", "120", "--seed", seed) for seed in SEEDS]
        for name in PROFILES
    }


def figures(runs, name, key):
    return [run[key] for run in runs[name]]


@pytest.mark.parametrize(
    ("slower", "faster"), [("indoor", "warehouse"), ("warehouse", "outdoor"), ("outdoor", "competition")]
)
def test_mean_speeds_are_ordered(runs, slower, faster):
    assert max(figures(runs, slower, "mean_speed")) < min(figures(runs, faster, "mean_speed"))


@pytest.mark.parametrize("careful", ["indoor", "outdoor", "warehouse"])
def test_competition_has_the_least_clearance(runs, careful):
    assert mean(figures(runs, "competition", "min_clearance")) < mean(figures(runs, careful, "min_clearance"))


def test_outdoor_keeps_the_largest_distances(runs):
    others = [each for name in PROFILES if name != "outdoor" for each in figures(runs, name, "min_clearance")]
    assert mean(figures(runs, "outdoor", "min_clearance")) > max(others)


def test_indoor_stops_more_than_competition(runs):
    assert sum(figures(runs, "indoor", "stops")) > sum(figures(runs, "competition", "stops"))


@pytest.mark.parametrize("name", ["indoor", "outdoor", "warehouse"])
def test_careful_profiles_have_no_collisions(runs, name):
    assert not any(figures(runs, name, "collisions"))


@pytest.mark.parametrize("name", PROFILES)
def test_runs_are_deterministic(runs, name):
    assert all(figures(runs, name, "deterministic"))
    assert len(set(figures(runs, name, "digest"))) == len(runs[name])


def test_environment_guide_states_the_measured_figures(runs):
    """Within the tolerance that another processor's floating point may need in a chaotic run."""
    row = r"^\| (\w+) \| (\d) \| ([\d.]+) \| ([\d.]+) \| (\d+) \| (\d+) \|$"
    rows = re.findall(row, GUIDE.read_text(encoding="utf-8"), re.MULTILINE)
    assert {(name, seed) for name, seed, *_ in rows} == {(name, seed) for name in PROFILES for seed in SEEDS}
    for name, seed, speed, clearance, stops, collisions in rows:
        if SEEDS.index(seed) >= len(runs[name]):
            continue
        run = runs[name][SEEDS.index(seed)]
        assert run["mean_speed"] == pytest.approx(float(speed), rel=0.1)
        assert run["min_clearance"] == pytest.approx(float(clearance), abs=0.1)
        assert run["stops"] == pytest.approx(int(stops), abs=6)
        assert run["collisions"] == pytest.approx(int(collisions), abs=1)
