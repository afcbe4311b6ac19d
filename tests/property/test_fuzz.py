"""A small part of `python tests/fuzz`, which feeds every parser with mutated inputs for as long as desired."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

FUZZ = Path(__file__).parents[1] / "fuzz"
INPUTS = 1550


@pytest.mark.slow
def test_no_mutated_input_causes_more_than_a_refusal(tmp_path):
    done = subprocess.run(
        [sys.executable, str(FUZZ), "--inputs", str(INPUTS), "--seed", "1", "--report", str(tmp_path / "report.json")],
        capture_output=True, text=True, cwd=tmp_path, timeout=240, check=False,
        env={**os.environ, "ROS_LOG_DIR": str(tmp_path)},
    )  # fmt: skip
    assert (tmp_path / "report.json").exists(), done.stderr[-2000:]
    report = json.loads((tmp_path / "report.json").read_text())
    assert report["findings"] == {} and done.returncode == 0
    assert sum(each["inputs"] for each in report["parsers"].values()) == INPUTS


def test_an_injected_fault_is_found(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(str(FUZZ))
    import importlib

    target = importlib.import_module("targets").Target("broken", lambda: ["a"], lambda text: 1 / 0)
    findings: dict[str, dict[str, object]] = {}
    fuzz = importlib.import_module("feeding").feed
    fuzz(target, 5, 1, findings)
    assert [each["times"] for each in findings.values()] == [5]
