"""Each row of the course page's checks is run and compared, or skipped with the reason."""

from __future__ import annotations

import importlib
import os
from pathlib import Path

import pytest
from course.evidence import SHOWN, has_test
from course.page import make_workspace, page
from course.rows import Row, rows
from course.table import ALIKE, CHECKS, COMPLETE, OWN, SLOW, Check, reason

for _module in sorted(Path(__file__).parent.glob("checks_*.py")):
    importlib.import_module(f"course.{_module.stem}")


@pytest.fixture(scope="module")
def workspace(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The page's workspace as printed; read-only by convention."""
    return make_workspace(tmp_path_factory.mktemp("printed"))


@pytest.fixture(scope="module")
def complete(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The page's workspace with substitutes for the files that it does not print."""
    return make_workspace(tmp_path_factory.mktemp("complete"), complete=True)


@pytest.fixture(scope="module")
def passed() -> set[Check]:
    """The checks that have passed and would do the same for another row."""
    return set()


@pytest.mark.parametrize(
    "row",
    [pytest.param(row, marks=pytest.mark.slow if row.number in SLOW else ()) for row in rows().values()],
    ids=str,
)
def test_row_of_the_course_holds(
    row: Row, passed: set[Check], request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if row.number in SHOWN:
        request.getfixturevalue("record_property")("shown_by", SHOWN[row.number])
        assert has_test(SHOWN[row.number])
        return
    check = CHECKS.get(row.number)
    if check is None:
        pytest.skip(reason(row.number))
    if check in passed:
        return
    workspace, complete = (request.getfixturevalue(each) for each in ("workspace", "complete"))
    monkeypatch.chdir(workspace / "src" / "my_package")
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "log"))
    with page(complete if row.number in COMPLETE else workspace, tmp_path, own=row.number in OWN) as running:
        check(running, row)
    if row.number in ALIKE:
        passed.add(check)


def test_no_row_is_both_checked_and_shown() -> None:
    assert not SHOWN.keys() & CHECKS.keys()


@pytest.mark.skipif(bool(os.environ.get("BOT_CONSOLE_COURSE")), reason="BOT_CONSOLE_COURSE names a course")
def test_course_is_present() -> None:
    pytest.skip("BOT_CONSOLE_COURSE names no course")
