"""Collects the differences found when the recorded programs ran on the real rclpy of PyPI.

    BOT_CONSOLE_TESTS_RECORD=FOLDER .ci/on_rclpy && python tools/rclpy_releases.py FOLDER

Writes `tests/contract/live/DISTRO.json`, from which `python tools/what_runs.py` makes a table in the documentation.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

LIVE = Path(__file__).resolve().parents[1] / "tests" / "contract" / "live"


def main(folder: Path) -> None:
    """Write one file for each distribution that has results in the folder."""
    for distro in ("jazzy", "kilted"):
        areas = sorted(folder.glob(f"{distro}-*.json"))
        if areas:
            found = {case: got for each in areas for case, got in json.loads(each.read_text("utf-8")).items()}
            text = json.dumps(found, indent=1, ensure_ascii=False, sort_keys=True)
            (LIVE / f"{distro}.json").write_text(text + "\n", "utf-8")
            print(f"{distro}: {len(found)} cases differ")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
