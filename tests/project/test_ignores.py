"""Comments that silence a checker give a reason: on the same line, or next to it if they apply to a whole file."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
WRITERS = {ROOT / "runtime" / "rosidl" / each for each in ("emit.py", "emit_holder.py")}
"""These write such comments into generated files."""
ON_A_LINE = re.compile(r"#\s*(?:noqa(?::[ A-Z0-9,]+)?|(?:type|pyright):\s*ignore(?:\[[^\]]*\])?)(?![\w:])(.*)")
FOR_A_FILE = re.compile(
    r"^#\s*(?:pyright:\s*(?:(?:report\w+=\w+|basic|standard),?\s*)+|ruff:\s*noqa(?::[ A-Z0-9,]+)?)(.*)"
)
WORDS = re.compile(r"[^\W\d_]{2,}")


def sources() -> Iterator[Path]:
    for folder in ("tui", "runtime", "nodes", "launch", "tools"):
        found = set((ROOT / folder).rglob("*.py")) - WRITERS
        yield from sorted(each for each in found if "generated" not in each.parts)


def lines_without_reason(text: str) -> Iterator[int]:
    """The numbers of the lines without a reason."""
    lines = text.splitlines()
    for number, (above, line, below) in enumerate(zip(["", *lines], lines, [*lines[1:], ""], strict=False), 1):
        if match := ON_A_LINE.search(line):
            message = match[1]
        elif match := FOR_A_FILE.match(line):
            message = " ".join([match[1], *(each for each in (above, below) if each.startswith("#"))])
        else:
            continue
        if len(WORDS.findall(message)) < 2:
            yield number


def test_each_ignore_has_a_reason() -> None:
    found = [
        f"{path.relative_to(ROOT)}:{number}"
        for path in sources()
        for number in lines_without_reason(path.read_text(encoding="utf-8"))
    ]
    assert not found, "\n".join(found)


@pytest.mark.parametrize(
    ("text", "lines"),
    [
        ("a = b  # type: ignore\n", [1]),
        ("a = b  # type: ignore[misc] -- upstream's way\n", []),
        ("a = b  # pyright: ignore[reportPrivateUsage]\nc = d  # noqa: E731\n", [1, 2]),
        ("def a():  # noqa: N802 -- ROS's name\n", []),
        ("# pyright: reportPrivateUsage=false\n\nimport a\n", [1]),
        ("# pyright: reportPrivateUsage=false\n# One library, as upstream.\n", []),
    ],
)
def test_ignore_comments_are_recognised(text: str, lines: list[int]) -> None:
    assert list(lines_without_reason(text)) == lines
