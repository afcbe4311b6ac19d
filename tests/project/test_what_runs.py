"""The page of what runs says what can be imported."""

import importlib.util
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def tool():
    spec = importlib.util.spec_from_file_location("what_runs", ROOT / "tools" / "what_runs.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_page_is_made_by_the_script():
    assert (ROOT / "docs" / "what-runs.md").read_text(encoding="utf-8") == tool().page(), "python tools/what_runs.py"


def test_packages_that_are_not_here_say_what_brings_them():
    rows = [each.strip("|").split("|") for each in tool().page().splitlines() if each.startswith("| `")]
    assert [row[0] for row in rows if row[1].strip() == "no" and not row[2].strip()] == []
