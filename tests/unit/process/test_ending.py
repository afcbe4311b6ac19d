"""Output and exit code of a process that ends without finalizing its interpreter."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

PROGRAM = """
import atexit, os, sys
from bot_console.runtime.process.ending import run_exit_functions
atexit.register(lambda: print("last word", file=sys.stderr))
print("first word")
os._exit(run_exit_functions(3))
"""


def run_to_end(output: Any) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-c", PROGRAM]
    buffered = {name: value for name, value in os.environ.items() if name != "PYTHONUNBUFFERED"}
    return subprocess.run(command, stdout=output, stderr=subprocess.PIPE, text=True, check=False, env=buffered)


def test_exit_functions_run_and_output_is_flushed() -> None:
    end = run_to_end(subprocess.PIPE)
    assert (end.returncode, end.stdout, end.stderr) == (3, "first word\n", "last word\n")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs /dev/full")
def test_unwritable_output_gives_the_exit_code_of_the_interpreter() -> None:
    with open("/dev/full", "w") as full:
        assert run_to_end(full).returncode == 120
