"""Failed tests run again in a separate process; a test that fails both times is a failure of the run."""

import os
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pytest

HELPERS = Path(__file__).parents[1] / "helpers"
ONLY_XDIST = {"PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1", "PYTEST_PLUGINS": "xdist.plugin", "PYTEST_ADDOPTS": ""}
"""Environment of each pytest below: importing the other plug-ins takes most of its time."""
ON_CI = ("CI", "BUILD_NUMBER")
"""Variables for which pytest does not shorten its last lines, which then repeat the explanation of a failure."""
TESTS = """
import os
from pathlib import Path

import pytest

tried, left = Path("tried"), []


@pytest.mark.parametrize("name", ["a b", "c::d[e]"])
def test_too_late(name):
    if not (Path(f"{tried}{len(name)}")).exists():
        Path(f"{tried}{len(name)}").touch()
        raise AssertionError("too late")


@pytest.fixture
def stumbling():
    assert not left


def test_leaves_something():
    left.append(1)


def test_stumbles(stumbling):
    pass
"""
ALWAYS = """

def test_is_wrong():
    assert len(tried.parts) == 2
"""
EXPLAINED = "where 1 = len(('tried',))"


@pytest.mark.slow
def test_only_tests_that_fail_in_both_tries_are_failures(tmp_path: Path) -> None:
    (tmp_path / "test_it.py").write_text(TESTS + ALWAYS)
    assert run(tmp_path, "1")[:2] == (1, "1 failed, 4 passed, 4 rerun")
    assert failures(tmp_path) == ["test_is_wrong"]


@pytest.mark.slow
def test_second_try_that_cannot_start_leaves_the_first_as_a_failure(tmp_path: Path) -> None:
    spoils = "def test_spoils():\n    Path('conftest.py').write_text('import nothing_there')\n    assert 0\n"
    (tmp_path / "test_it.py").write_text(TESTS + "\n\n" + spoils)
    assert run(tmp_path, "0", "-k", "spoils")[:2] == (1, "1 failed, 4 deselected, 1 rerun")


@pytest.mark.slow
def test_run_in_which_all_pass_at_last_passes(tmp_path: Path) -> None:
    (tmp_path / "test_it.py").write_text(TESTS)
    assert run(tmp_path, "1")[:2] == (0, "4 passed, 3 rerun")
    assert failures(tmp_path) == []


@pytest.mark.slow
def test_tests_are_tried_again_without_workers_too(tmp_path: Path) -> None:
    (tmp_path / "test_it.py").write_text(TESTS + ALWAYS)
    assert run(tmp_path, "0")[:2] == (1, "1 failed, 4 passed, 4 rerun")


@pytest.mark.slow
def test_second_try_explains_what_a_worker_does_not(tmp_path: Path) -> None:
    (tmp_path / "test_it.py").write_text(TESTS + ALWAYS)
    code, counts, shown = run(tmp_path, "1", "-k", "is_wrong")
    assert (code, counts) == (1, "1 failed, 1 rerun")
    assert shown.count(">   " + ALWAYS.splitlines()[-1]) == 2, "each try is shown"
    assert shown.count(EXPLAINED) == 1


def failures(folder: Path) -> list[str | None]:
    """The names of the tests that failed according to the report of the run."""
    cases = ElementTree.parse(folder / "junit.xml").iter("testcase")
    return [each.get("name") for each in cases if not {"failure", "error"}.isdisjoint(part.tag for part in each)]


def run(folder: Path, workers: str, *more: str) -> tuple[int, str, str]:
    """The exit code, the counts of the last line, and the whole output."""
    (folder / "conftest.py").write_text('pytest_plugins = ["second_tries"]\n')
    environment = {name: value for name, value in os.environ.items() if name not in ON_CI}
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-n", workers, "--junitxml=junit.xml", "-p", "no:cacheprovider", *more],
        cwd=folder, env={**environment, "PYTHONPATH": str(HELPERS), **ONLY_XDIST},
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    return done.returncode, done.stdout.splitlines()[-1].strip("= ").rpartition(" in ")[0], done.stdout
