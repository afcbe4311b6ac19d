"""`launch_test FILE [NAME:=VALUE ...]`: run the tests of a file without pytest."""

from __future__ import annotations

import argparse
import importlib.util
import sys
import unittest
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from launch_testing.test_run import DESCRIPTION, test_runs


def main(words: Sequence[str] | None = None) -> int:
    """Run a test file; 0 where all tests passed."""
    parser = argparse.ArgumentParser("launch_test", description="Run the tests of a launch description.")
    parser.add_argument("test_file", type=Path)
    parser.add_argument("launch_arguments", nargs="*", metavar="NAME:=VALUE")
    given = parser.parse_args(words)
    if not given.test_file.is_file():
        parser.error(f"{given.test_file} does not exist")
    runs = test_runs(load(given.test_file))
    if not runs:
        parser.error(f"{given.test_file} has no function {DESCRIPTION}")
    pairs = (each.partition(":=") for each in given.launch_arguments)
    arguments = {name: value for name, assigned, value in pairs if assigned}
    result = unittest.TextTestResult(unittest.runner._WritelnDecorator(sys.stderr), True, 2)
    for run in runs:
        run.run(arguments, result)
    result.printErrors()
    print(f"Ran {result.testsRun} tests: {'OK' if result.wasSuccessful() else 'FAILED'}", file=sys.stderr)
    return 0 if result.wasSuccessful() and result.testsRun else 1


def load(path: Path) -> Any:
    """The module of a test file, whatever its name ends in."""
    spec = importlib.util.spec_from_file_location(path.name.partition(".")[0], path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module
