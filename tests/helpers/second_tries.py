"""A pytest plug-in that tries a test that failed once more: at the end, alone, in a process of its own.

On a busy machine a part of what a test waits for may come too late, and a test may stumble over what another has left
in its process. The summary counts what needed its second try (`rerun`) and shows what failed in the first; a fault of
the code fails both.

Only the second try explains the values of an assertion: pytest rewrites the assertions of a file to do so, which took a
third of what it costs the workers to start.
"""

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Generator
from pathlib import Path
from typing import Any

import pytest
from _pytest.assertion.rewrite import AssertionRewritingHook

MAX_SECOND_TRIES = 20
"""More failures than these are not chance: they are reported as they are."""
TRIES = "BOT_CONSOLE_TESTS_SECOND_TRIES"
"""Names, in the process of the second tries, the file of the tests to try and to which their reports are written."""

_place = os.environ.pop(TRIES, None)

_first_tries: dict[str, list[pytest.TestReport]] = {}
"""The failures of first tries, by test."""


def pytest_configure(config: pytest.Config) -> None:
    """Let a worker import the tests as they are."""
    if hasattr(config, "workerinput"):
        sys.meta_path[:] = [each for each in sys.meta_path if not isinstance(each, AssertionRewritingHook)]


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport() -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """A failure of a first try is none yet; what passed has no use for keywords, most of what a worker would send."""
    report = yield
    if report.failed and _place is None:
        report.outcome = "rerun"  # type: ignore[assignment] # an outcome of ours
    if report.passed:
        report.keywords = {}
    return report


def pytest_report_teststatus(report: pytest.TestReport) -> tuple[str, str, tuple[str, dict[str, bool]]] | None:
    """What the terminal shows of it."""
    return ("rerun", "R", ("RERUN", {"yellow": True})) if str(report.outcome) == "rerun" else None


def pytest_runtest_logreport(report: pytest.TestReport) -> None:
    """Keep what failed in a first try."""
    if str(report.outcome) == "rerun":
        _first_tries.setdefault(report.nodeid, []).append(report)


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """The process of the second tries runs nothing else, and hands on its reports."""
    if _place is not None:
        place = Path(_place)
        wanted = set(json.loads(place.read_text("utf-8")))
        items[:] = [each for each in items if each.nodeid in wanted]
        place.write_text("", "utf-8")
        config.pluginmanager.register(_Reports(config, place))


class _Reports:
    def __init__(self, config: pytest.Config, place: Path) -> None:
        self._config, self._place = config, place

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        data = self._config.hook.pytest_report_to_serializable(config=self._config, report=report)
        with self._place.open("a", encoding="utf-8") as file:
            file.write(json.dumps(data) + "\n")


@pytest.hookimpl(wrapper=True)
def pytest_runtestloop(session: pytest.Session) -> Generator[None, object, object]:
    """After all others: the second tries, whose reports count."""
    done = yield
    if _first_tries and not hasattr(session.config, "workerinput"):
        for report in _reports(session.config):
            session.config.hook.pytest_runtest_logreport(report=report)
    return done


def _reports(config: pytest.Config) -> list[pytest.TestReport]:
    """Those of the second tries; of a test that did not run again, those of its first."""
    again = _second_tries(config) if len(_first_tries) <= MAX_SECOND_TRIES else []
    tried = {each.nodeid for each in again if each.when == "teardown"}
    for nodeid in _first_tries.keys() - tried:
        for report in _first_tries[nodeid]:
            report.outcome = "failed"
            again.append(report)
    return again


def _second_tries(config: pytest.Config) -> list[pytest.TestReport]:
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder, "tests.json")
        place.write_text(json.dumps([*_first_tries]), "utf-8")
        files = {str(config.rootpath / each.partition("::")[0]): None for each in _first_tries}
        subprocess.run(
            [sys.executable, "-m", "pytest", "-q", "-n", "0", "-m", "", *files],
            cwd=config.invocation_params.dir, env={**os.environ, "PYTEST_ADDOPTS": "", TRIES: str(place)},
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, check=False,
        )  # fmt: skip
        lines: list[Any] = [json.loads(each) for each in place.read_text("utf-8").splitlines()]
    # A run that could not even start has left the list of tests there.
    reports = [each for each in lines if isinstance(each, dict)]
    return [config.hook.pytest_report_from_serializable(config=config, data=each) for each in reports]


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """A first try that failed is shown though the second passed: a fault that is rare would never be seen else."""
    for report in terminalreporter.getreports("rerun"):
        terminalreporter.write_sep("_", f"first try of {report.nodeid}")
        terminalreporter.write_line(report.longreprtext)
        for name, text in report.sections:
            terminalreporter.write_sep("-", name)
            terminalreporter.write_line(text)
