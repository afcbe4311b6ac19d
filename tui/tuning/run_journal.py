"""The journal of a tuning job: one line per run, on disk as soon as the run has ended, so that no run is repeated."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any, cast

from bot_console.tui.tuning.specification import Trial, TuningSpecification


class TuningJournal:
    """The reports of runs by trial. A line that a crash has truncated is ignored, and that run is repeated.

    Methods raise `OSError` if the file cannot be read or written.
    """

    def __init__(self, folder: Path, specification: TuningSpecification, *, resume: bool) -> None:
        """Start empty or, with `resume`, with the reports that the last job with an equal specification has left."""
        self.path = folder / f"{specification.digest}.jsonl"
        self._reports: dict[str, Mapping[str, Any]] = {}
        folder.mkdir(parents=True, exist_ok=True)
        whole = self._read() if resume else 0
        self._file = self.path.open("r+b" if self.path.exists() else "w+b")
        self._file.truncate(whole)
        self._file.seek(whole)
        self.resumed = len(self._reports)
        """The number of runs found at the start."""

    def _read(self) -> int:
        """Read the existing reports; returns the number of bytes up to the end of the last valid line."""
        if not self.path.exists():
            return 0
        whole = 0
        for line in self.path.read_bytes().splitlines(keepends=True):
            try:
                entry: Any = json.loads(line) if line.endswith(b"\n") else None
            except (ValueError, RecursionError):
                break
            given = cast("dict[str, Any]", entry) if isinstance(entry, dict) else dict[str, Any]()
            trial, report = given.get("trial"), given.get("report")
            if not (isinstance(trial, str) and isinstance(report, dict)):
                break
            self._reports[trial] = cast("dict[str, Any]", report)
            whole += len(line)
        return whole

    def report(self, trial: Trial) -> Mapping[str, Any] | None:
        """The report of a run; None if it has not been made."""
        return self._reports.get(trial.key)

    def add(self, trial: Trial, report: Mapping[str, Any]) -> None:
        """Save a report; it is on disk when this returns."""
        self._reports[trial.key] = report
        self._file.write(json.dumps({"trial": trial.key, "report": report}).encode() + b"\n")
        self._file.flush()
        os.fsync(self._file.fileno())

    def close(self) -> None:
        """Close the file, which is kept."""
        self._file.close()
