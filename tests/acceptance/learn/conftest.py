"""A student for each test; the student's terminals are closed at its end."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from helpers.student import Student


@pytest.fixture
def student(tmp_path: Path) -> Iterator[Callable[..., Student]]:
    """A function that makes a student who opens a course, in a copy of a workspace if one is given."""
    at_work: list[Student] = []

    def open_course(course: Path, workspace: Path | None = None) -> Student:
        at_work.append(Student(tmp_path, course, workspace))
        at_work[-1].begin()
        return at_work[-1]

    yield open_course
    for each in at_work:
        each.close()
