"""The page "What runs" is up to date, and says what can be imported."""

import importlib.util
import json
from pathlib import Path

from helpers.recorded.cases import differing_on_purpose

ROOT = Path(__file__).resolve().parents[2]


def tool():
    spec = importlib.util.spec_from_file_location("what_runs", ROOT / "tools" / "what_runs.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_page_is_generated_by_the_script():
    assert (ROOT / "docs" / "what-runs.md").read_text(encoding="utf-8") == tool().page(), "python tools/what_runs.py"


def test_unavailable_packages_report_alternatives():
    rows = [each.strip("|").split("|") for each in tool().page().splitlines() if each.startswith("| `")]
    assert [row[0] for row in rows if row[1].strip() == "no" and not row[2].strip()] == []


def test_each_difference_of_a_live_rclpy_has_one_decision():
    what_runs = tool()
    for distro in what_runs.RELEASES:
        outcomes = json.loads((what_runs.LIVE / f"{distro}.json").read_text("utf-8"))
        decided = sorted(case for _, cases in what_runs.decisions() for case in cases[distro])
        assert decided == sorted(outcomes)
    assert [row["what"] for row, cases in what_runs.decisions() if not any(cases.values())] == []


def test_runtime_differs_from_recordings_only_where_decided():
    newer = {
        case for row, cases in tool().decisions() if row["here"] == "newer" for each in cases.values() for case in each
    }
    assert newer == set(differing_on_purpose("rclpy"))
