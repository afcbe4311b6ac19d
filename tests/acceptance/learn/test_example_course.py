"""The example course of the documentation has no mistake, and can be completed from its text alone."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from bot_console.tui.cli.main import main
from helpers.student import Student

SERVICES = Path(__file__).parents[3] / "docs" / "examples" / "services"


def test_lint_finds_nothing_in_example_course(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["lint", str(SERVICES)]) == 0
    assert "4 steps" in capsys.readouterr().err


@pytest.mark.soak
@pytest.mark.timeout(600)
def test_example_course_is_done_from_its_text_alone(student: Callable[[Path], Student]) -> None:
    at = student(SERVICES)
    first, second, _ = at.shells
    for step in at.course.steps():
        shell = second if at.expected else first
        for snippet in step.snippets:
            if snippet.path:
                at.write(snippet.path, snippet.text)
            else:
                for line in snippet.text.splitlines():
                    shell.start(line)
                    if shell is second:
                        shell.ended()
        at.does(step.id)
