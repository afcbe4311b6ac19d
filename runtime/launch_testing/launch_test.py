"""`launch_test FILE [NAME:=VALUE ...]`: run the tests of a file without pytest."""

from __future__ import annotations

import argparse
import importlib.util
import logging
import sys
import unittest
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import launch.logging
from launch_testing.junitxml import TimedResult, write_report
from launch_testing.test_run import DESCRIPTION, TestRun, test_runs
from ros2cli.launch_file import parse_launch_arguments
from ros2cli.launch_print import argument_lines


def main(words: Sequence[str] | None = None) -> int:
    """Run a test file; return 0 if all tests passed."""
    parser = _parser()
    given = parser.parse_args(words)
    if given.verbose:
        launch.logging.launch_config.level = logging.DEBUG
    path = Path(given.launch_test_file)
    if not path.is_file():
        parser.error(f"Test file '{path}' does not exist")
    try:
        runs = test_runs(load(path.absolute()))
        if not runs:
            raise AttributeError(f"module '{path.stem}' has no attribute '{DESCRIPTION}'")
        if given.show_args:
            for line in argument_lines(runs[0].describe()[0]):
                print(line)
            return 0
        return _run(runs, dict(parse_launch_arguments(given.launch_arguments)), given)
    except Exception as error:  # a test file is a program, so its exceptions are reported as command-line errors
        parser.error(str(error))


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser("launch_test", description="Run the tests of a launch description.")
    parser.add_argument("launch_test_file", help="the test file")
    parser.add_argument("--package-name", help="the package of the test, for names in reports")
    parser.add_argument("-v", "--verbose", action="store_true", help="show more of what launch does")
    parser.add_argument(
        "-s",
        "--show-args",
        "--show-arguments",
        action="store_true",
        help="show the arguments of the description",
    )
    parser.add_argument("launch_arguments", nargs="*", help="'<name>:=<value>'; of several of one name the last counts")
    parser.add_argument("--junit-xml", dest="xmlpath", help="write a report for JUnit there")
    return parser


def _run(runs: Sequence[TestRun], arguments: dict[str, str], given: argparse.Namespace) -> int:
    result = TimedResult(unittest.runner._WritelnDecorator(sys.stderr), True, 2)
    for run in runs:
        run.run(arguments, result)
    result.printErrors()
    print(f"Ran {result.testsRun} tests: {'OK' if result.wasSuccessful() else 'FAILED'}", file=sys.stderr)
    if given.xmlpath:
        name = Path(given.launch_test_file).stem
        write_report(given.xmlpath, f"{given.package_name or name}.{name}", result)
    return 0 if result.wasSuccessful() and (result.testsRun or result.skipped) else 1


def load(path: Path) -> Any:
    """Import a test file as a module, whatever its extension."""
    spec = importlib.util.spec_from_file_location(path.name.partition(".")[0], path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module
