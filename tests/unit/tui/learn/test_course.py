"""A course is read from Markdown files; a mistake in it is named with its file and line."""

from __future__ import annotations

from pathlib import Path

import pytest
from bot_console.tui.learn.condition_syntax import read_condition
from bot_console.tui.learn.course import CourseError, find_course, names, read_course
from bot_console.tui.learn.skeleton import write_skeleton
from bot_console.tui.pane_table import PANES

CHAPTER = "# One\n\nAbout.\n\n## First\n\nWhy.\n\n```console\nls\n```\n\n```step\nsaw-node * with speed as node\n```\n"


def course(folder: Path, *chapters: str, index: str = "# Mine\n\nnode = talker\n") -> Path:
    folder.mkdir(exist_ok=True)
    (folder / "course.md").write_text(index, encoding="utf-8")
    for number, text in enumerate(chapters, 1):
        (folder / f"{number:02}.md").write_text(text, encoding="utf-8")
    return folder


def test_chapters_steps_and_defaults_are_read(tmp_path: Path) -> None:
    found = read_course(course(tmp_path, CHAPTER, "# Two\n## Second\n```step\nexpect-file *.py\n```\n"))
    assert (found.title, found.defaults) == ("Mine", {"node": "talker"})
    assert [each.title for each in found.chapters] == ["One", "Two"]
    first = found.steps()[0]
    assert (first.id, first.text, first.snippets[0].text, first.snippets[0].path) == ("first", "Why.", "ls", "")
    assert first.conditions[0].words == ("*", "with", "speed", "as", "node")


def test_listing_names_its_file_and_keeps_its_lines(tmp_path: Path) -> None:
    text = "# One\n## A\n````python src/a.py\nx = 1\n```\n# no title\n````\n```step\nexpect-file a.py\n```\n"
    snippet = read_course(course(tmp_path, text)).steps()[0].snippets[0]
    assert (snippet.path, snippet.text) == ("src/a.py", "x = 1\n```\n# no title")


@pytest.mark.parametrize(
    ("text", "line", "reason"),
    [
        ("## A\n```step\nexpect-file a\n```\n", 1, "a chapter begins with its title"),
        ("# A\n# B\n", 2, "a second `# Title`"),
        ("# A\n## S\nprose\n", 2, "the step 'S' has no fence `step`"),
        ("# A\n## S\n```step\nsaw-nod x\n```\n", 4, "'saw-nod' is not one of saw-node"),
        ("# A\n## S\n```step\nsaw-move far\n```\n", 4, "a length in m"),
        ("# A\n## S\n```step\nsaw-node\n```\n", 4, "write saw-node NAME|*"),
        ("# A\n## S\n```step\nsaw-set 'x\n```\n", 4, "No closing quotation"),
        ("# A\n## S\n```step\nsaw-set x\n", 3, "this fence is not closed"),
        ("# A\n```step\nsaw-set x\n```\n", 1, "conditions belong below a step"),
        ("# A\n```grade x\nrun a b\n```\n", 2, "write ```grade POINTS Title"),
        ("# A\n```grade 1 T\nset /a b 1\n```\n", 2, "nothing is started"),
        ("# A\n```grade 1 T\nrun a b\n```\n", 2, "the row checks nothing"),
        ("# A\n```grade 1 T\nrun a b\nsett /a b 1\n```\n", 4, "'sett' is not one of"),
        ("# A\n```grade 1 T\ndrive far\n```\n", 3, "write drive SECONDS s"),
    ],
)
def test_mistake_is_named_with_file_and_line(text: str, line: int, reason: str, tmp_path: Path) -> None:
    folder = course(tmp_path, text)
    with pytest.raises(CourseError) as raised:
        read_course(folder)
    assert str(raised.value).startswith(f"{folder / '01.md'}:{line}: ")
    assert reason in str(raised.value)


def test_two_steps_of_one_title_are_refused(tmp_path: Path) -> None:
    with pytest.raises(CourseError, match="two steps are called 'First'"):
        read_course(course(tmp_path, CHAPTER, CHAPTER))


def test_file_that_is_not_utf_8_is_named(tmp_path: Path) -> None:
    folder = course(tmp_path, CHAPTER)
    (folder / "02.md").write_bytes(b"# \xff\n")
    with pytest.raises(CourseError, match=r"02\.md: not UTF-8 text"):
        read_course(folder)


def test_unknown_course_names_those_that_exist(tmp_path: Path) -> None:
    with pytest.raises(CourseError, match="there is no course 'week7'; the courses are week6"):
        find_course("week7")
    with pytest.raises(CourseError, match=r"needs a file course\.md"):
        find_course(str(tmp_path))


@pytest.mark.parametrize("name", names())
def test_bundled_course_is_valid_and_has_rows(name: str) -> None:
    found = read_course(find_course(name))
    assert len(found.steps()) > 10
    assert found.rows()


@pytest.mark.parametrize("pane", [each.id for each in PANES])
def test_step_may_wait_for_any_pane(pane: str) -> None:
    assert read_condition(f"saw-pane {pane}").words == (pane,)


def test_skeleton_is_a_valid_course(tmp_path: Path) -> None:
    write_skeleton(tmp_path / "new")
    assert [each.title for each in read_course(tmp_path / "new").steps()] == ["A node with a parameter"]
