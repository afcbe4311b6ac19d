"""Temporary files are deleted with their process; the next process deletes those of a killed one."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

if os.name == "nt":
    pytest.skip("needs Unix file locks", allow_module_level=True)

PROGRAM = """
import sys
from bot_console.runtime.process.scratch import scratch, scratch_file
print(scratch_file("launch_params_", "a: 1"), flush=True)
sys.stdin.readline()
"""


def start_process(base: Path) -> tuple[subprocess.Popen[str], Path]:
    process = subprocess.Popen(
        [sys.executable, "-c", PROGRAM], env={**os.environ, "TMPDIR": str(base)}, text=True,
        stdin=subprocess.PIPE, stdout=subprocess.PIPE,
    )  # fmt: skip
    assert process.stdout is not None
    return process, Path(process.stdout.readline().strip())


def test_files_are_deleted_at_exit_and_those_of_a_killed_process_by_the_next(tmp_path: Path) -> None:
    base = tmp_path / f"bot-console-{os.geteuid()}"
    killed, left = start_process(tmp_path)
    living, kept = start_process(tmp_path)
    assert left.read_text() == kept.read_text() == "a: 1" and base.stat().st_mode & 0o777 == 0o700
    killed.send_signal(signal.SIGKILL)
    killed.wait()
    assert left.exists(), "a killed process does not clean up"
    living.communicate("\n")
    assert not kept.exists() and left.exists()
    last, _ = start_process(tmp_path)
    assert not left.exists()
    last.communicate("\n")
    assert list((base / "files").iterdir()) == []


def test_folder_of_another_user_is_not_used(tmp_path: Path) -> None:
    theirs = tmp_path / "theirs"
    theirs.mkdir()
    (tmp_path / f"bot-console-{os.geteuid()}").symlink_to(theirs)
    process, file = start_process(tmp_path)
    assert file.exists() and list(theirs.iterdir()) == []
    process.communicate("\n")
    assert not file.exists()


TWO_LAUNCHES = """
import threading
from bot_console.runtime.process import scratch as module
both, clean = threading.Barrier(2), module.clean
def clean_beside_the_other(base):
    try:
        both.wait(0.5)  # neither has made its folder yet, unless one waits for the other
    except threading.BrokenBarrierError:
        pass
    clean(base)
module.clean = clean_beside_the_other
launches = [threading.Thread(target=module.scratch_file, args=("launch_params_", "a: 1")) for _ in range(2)]
for each in launches:
    each.start()
for each in launches:
    each.join()
print(len(list(module.scratch().parent.glob("*/launch_params_*"))), len(list(module.scratch().parent.iterdir())))
"""


def test_simultaneous_launches_share_one_folder(tmp_path: Path) -> None:
    done = run(TWO_LAUNCHES, tmp_path)
    assert done.stdout.split() == ["2", "1"], done.stderr
    assert list((tmp_path / f"bot-console-{os.geteuid()}" / "files").iterdir()) == []


WRITES_AT_THE_END = """
import atexit
from bot_console.runtime.process import scratch as module
def write():
    try:
        module.scratch_file("launch_params_", "a: 1")
    except OSError as error:
        print(error, flush=True)
atexit.register(write)  # comes after the folder's removal, as a thread may that is still starting something
def write_into_the_old_one(folder):
    try:
        (old / "launch_params_1").write_text("a: 1")
    except OSError:
        print("the folder is gone", flush=True)
    delete(folder)
old, delete = module.scratch(), module._delete
module._delete = write_into_the_old_one
"""


def test_files_written_during_exit_leave_nothing(tmp_path: Path) -> None:
    done = run(WRITES_AT_THE_END, tmp_path)
    assert done.stdout == "the folder is gone\nthe process is ending\n", done.stderr
    assert list((tmp_path / f"bot-console-{os.geteuid()}" / "files").iterdir()) == []


def run(program: str, base: Path) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "TMPDIR": str(base)}
    return subprocess.run([sys.executable, "-c", program], env=environment, text=True, capture_output=True, check=True)
