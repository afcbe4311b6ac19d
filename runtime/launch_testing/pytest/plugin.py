"""A pytest plugin: a module whose `generate_test_description` is marked `launch_test` is one test."""

from __future__ import annotations

import unittest
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from launch_testing.test_run import DESCRIPTION, test_runs
from ros2cli.launch_file import parse_launch_arguments

if TYPE_CHECKING:
    from types import ModuleType


class LaunchTestFailure(Exception):
    """Some test cases of a module have failed; their messages form this one."""


class LaunchTestItem(pytest.Item):
    """A test item for all runs of a module."""

    def __init__(self, *, module: ModuleType, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._module = module

    def runtest(self) -> None:
        """Execute the runs; raises `LaunchTestFailure`."""
        words = [each for some in self.config.getoption("--launch-args") or () for each in some]
        result = unittest.TestResult()
        for run in test_runs(self._module):
            run.run(parse_launch_arguments(words), result)
        bad = [*result.failures, *result.errors]
        if bad:
            raise LaunchTestFailure("\n\n".join(f"FAIL: {test}\n{text}" for test, text in bad))
        if not result.testsRun and not result.skipped:
            raise LaunchTestFailure(f"{self.name} has no tests")

    def repr_failure(self, excinfo: Any, style: Any = None) -> Any:
        """Return the tests' own tracebacks, without ours."""
        return (
            str(excinfo.value) if isinstance(excinfo.value, LaunchTestFailure) else super().repr_failure(excinfo, style)
        )

    def reportinfo(self) -> tuple[Path, int, str]:
        """Return the location of the item."""
        return self.path, 0, f"launch tests: {self.name}"


class LaunchTestModule(pytest.Module):
    """A module with a test description."""

    def collect(self) -> Iterator[Any]:
        """Yield a single item."""
        yield LaunchTestItem.from_parent(self, name=self.path.stem, module=self.obj)


def pytest_pycollect_makemodule(module_path: Path, parent: object) -> Any:
    """Collect modules with a marked description; leave all others to pytest."""
    if DESCRIPTION not in module_path.read_text(encoding="utf-8", errors="replace"):
        return None
    module = LaunchTestModule.from_parent(parent, path=module_path)
    marks = getattr(getattr(module.obj, DESCRIPTION, None), "pytestmark", [])
    return module if any(each.name in ("launch_test", "rostest") for each in marks) else None


def pytest_configure(config: Any) -> None:
    """Register the marker."""
    text = "mark a generate_test_description function as a launch test entrypoint"
    config.addinivalue_line("markers", f"launch_test: {text}")
    config.addinivalue_line("markers", f"rostest: {text}")
