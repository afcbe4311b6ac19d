"""Temporary files go with their process; what a killed one left goes when the next one starts."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

if os.name == "nt":
    pytest.skip("files are locked as on Unix", allow_module_level=True)

PROGRAM = """
import sys
from bot_console.runtime.process.scratch import scratch, scratch_file
print(scratch_file("launch_params_", "a: 1"), flush=True)
sys.stdin.readline()
"""


def started(base: Path) -> tuple[subprocess.Popen[str], Path]:
    process = subprocess.Popen(
        [sys.executable, "-c", PROGRAM], env={**os.environ, "TMPDIR": str(base)}, text=True,
        stdin=subprocess.PIPE, stdout=subprocess.PIPE,
    )  # fmt: skip
    assert process.stdout is not None
    return process, Path(process.stdout.readline().strip())


def test_they_go_with_their_process_and_those_of_a_killed_one_with_the_next(tmp_path: Path) -> None:
    base = tmp_path / f"bot-console-{os.geteuid()}"
    killed, left = started(tmp_path)
    living, kept = started(tmp_path)
    assert left.read_text() == kept.read_text() == "a: 1" and base.stat().st_mode & 0o777 == 0o700
    killed.send_signal(signal.SIGKILL)
    killed.wait()
    assert left.exists(), "a killed process cleans nothing"
    living.communicate("\n")
    assert not kept.exists() and left.exists()
    last, _ = started(tmp_path)
    assert not left.exists()
    last.communicate("\n")
    assert list((base / "files").iterdir()) == []


def test_a_folder_of_somebody_else_is_not_used(tmp_path: Path) -> None:
    theirs = tmp_path / "theirs"
    theirs.mkdir()
    (tmp_path / f"bot-console-{os.geteuid()}").symlink_to(theirs)
    process, file = started(tmp_path)
    assert file.exists() and list(theirs.iterdir()) == []
    process.communicate("\n")
    assert not file.exists()
