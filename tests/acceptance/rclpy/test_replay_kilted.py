"""The recorded programs with `BOT_CONSOLE_DISTRO=kilted`: they end as on the real rclpy of Kilted."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
import yaml
from helpers.recorded.cases import GIVEN, NOT_GIVEN, RECORDINGS
from helpers.recorded.releases import LIVE

pytestmark = [pytest.mark.recorded, pytest.mark.timeout(600), pytest.mark.skipif(not GIVEN, reason=NOT_GIVEN)]

SETUP = "from bot_console.runtime.importer import install; install()"
KILTED: dict[str, Any] = json.loads((LIVE / "kilted.json").read_text("utf-8"))
"""The outcomes of Kilted that differ from Jazzy's, by id."""
KEPT: dict[str, str] = yaml.safe_load((LIVE / "kilted_kept.yaml").read_text("utf-8"))
"""The cases in which Kilted is not followed, with the reason."""


def test_cases_end_as_on_kilted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("BOT_CONSOLE_DISTRO", "kilted")
    report = tmp_path / "report.json"
    words = [*KILTED, "--setup", SETUP, "--report", str(report)]
    subprocess.run([sys.executable, str(RECORDINGS / "replay.py"), *words], check=False, capture_output=True)
    differing = json.loads(report.read_text("utf-8"))["cases"]
    wrong = {case: differing.get(case, "as Jazzy") for case in KILTED if not _matches_kilted(case, differing)}
    assert sorted(wrong) == sorted(KEPT), {case: wrong.get(case) for case in sorted(set(wrong) ^ set(KEPT))}


def _matches_kilted(case: str, differing: dict[str, Any]) -> bool:
    if case not in differing:
        return False
    got = {key: value for key, value in differing[case]["got"].items() if key != "trace"}
    return got == KILTED[case]
