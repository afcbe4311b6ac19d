"""Reads courses: folders of Markdown files, one per chapter, with steps that have conditions. Pure except for reading.

The format is documented in `docs/courses.md`: `# Title` begins a chapter, `## Title` a step; a fence `step` contains
the step's conditions, a fence `grade` a row of the grading; any other fence is a snippet to type or to write.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from bot_console.tui.files.store_file import read_store
from bot_console.tui.learn.condition_syntax import Condition, read_condition
from bot_console.tui.learn.grade_row import GradeRow, read_grade_row

COURSES = Path(__file__).parent / "courses"
"""The folder of the courses that come with the program, each in a folder of its name."""
INDEX = "course.md"
"""The file with the course's title; the rest of it is the introduction."""
MAX_FILE_BYTES = 1_000_000
FENCE = re.compile(r"^(`{3,}|~{3,})\s*(\S*)\s*(.*?)\s*$")


class CourseError(ValueError):
    """A mistake in a course; the message says where, and how to fix it."""


@dataclass(frozen=True)
class Snippet:
    """A text to type into a shell or, with `path` (relative to the workspace), to write into a file."""

    text: str
    path: str = ""


@dataclass(frozen=True)
class Step:
    """One step; `id` is derived from the title and unique in the course."""

    id: str
    title: str
    text: str = ""
    snippets: tuple[Snippet, ...] = ()
    conditions: tuple[Condition, ...] = ()


@dataclass(frozen=True)
class Chapter:
    """A chapter: its steps, and the rows that it adds to the grading."""

    title: str
    text: str = ""
    steps: tuple[Step, ...] = ()
    rows: tuple[GradeRow, ...] = ()


@dataclass(frozen=True)
class Course:
    """A course, with all its chapters."""

    name: str
    title: str
    chapters: tuple[Chapter, ...]
    defaults: dict[str, str] = field(default_factory=dict[str, str])
    """Values of the names that texts use as `{name}`, until the student's own are known."""

    def steps(self) -> list[Step]:
        """All steps, in order."""
        return [step for chapter in self.chapters for step in chapter.steps]

    def rows(self) -> list[GradeRow]:
        """All rows of the grading, in order."""
        return [row for chapter in self.chapters for row in chapter.rows]

    def chapter_of(self, step: Step) -> Chapter:
        """The chapter of a step."""
        return next(each for each in self.chapters if step in each.steps)


def names() -> list[str]:
    """The names of the courses that come with the program."""
    return sorted(each.name for each in COURSES.iterdir() if (each / INDEX).is_file())


def find_course(given: str) -> Path:
    """The folder of a course, by its name or path; raises `CourseError` if there is none."""
    for folder in (COURSES / given, Path(given)):
        if (folder / INDEX).is_file():
            return folder
    if Path(given).is_dir():
        raise CourseError(f"{given}: a course needs a file {INDEX} with its title; `bot-console learn --new` makes one")
    raise CourseError(f"there is no course '{given}'; the courses are {', '.join(names())}, or name a folder")


def read_course(folder: Path) -> Course:
    """Read a course; raises `CourseError` for the first mistake."""
    index = _text(folder / INDEX)
    title, defaults = folder.name, dict[str, str]()
    for number, line in enumerate(index.splitlines(), 1):
        if line.startswith("# "):
            title = line[2:].strip()
        elif name := re.fullmatch(r"([a-z_]+) = (\S+)", line.strip()):
            defaults[name[1]] = name[2]
        elif line.startswith("## "):
            raise CourseError(f"{folder / INDEX}:{number}: steps belong in a separate file, beside {INDEX}")
    chapters = tuple(_chapter(path) for path in sorted(folder.glob("*.md")) if path.name != INDEX)
    course = Course(folder.name, title, chapters, defaults)
    if not course.steps():
        raise CourseError(f"{folder}: there is no step (`## Title`) in any file beside {INDEX}")
    seen: set[str] = set()
    for step in course.steps():
        if step.id in seen:
            raise CourseError(f"{folder}: two steps are called '{step.title}', so progress cannot tell them apart")
        seen.add(step.id)
    return course


def _text(path: Path) -> str:
    try:
        return read_store(path, MAX_FILE_BYTES).decode("utf-8")
    except OSError as error:
        raise CourseError(f"{path}: {error.strerror}") from None
    except UnicodeDecodeError:
        raise CourseError(f"{path}: not UTF-8 text; save it as UTF-8") from None


@dataclass
class _Section:
    """A heading and the content below it."""

    title: str
    line: int
    prose: list[str] = field(default_factory=list[str])
    snippets: list[Snippet] = field(default_factory=list[Snippet])
    conditions: list[Condition] = field(default_factory=list[Condition])
    rows: list[GradeRow] = field(default_factory=list[GradeRow])

    def text(self) -> str:
        """The prose, its paragraphs separated by blank lines."""
        return re.sub(r"\n{3,}", "\n\n", "\n".join(self.prose)).strip()


def _chapter(path: Path) -> Chapter:
    head, *steps = _sections(path, _text(path).splitlines())
    if not head.title:
        raise CourseError(f"{path}:1: a chapter begins with its title, as in `# First parameter`")
    if head.conditions:
        raise CourseError(f"{path}:{head.line}: conditions belong below a step (`## Title`)")
    found: list[Step] = []
    for part in steps:
        if not part.conditions:
            raise CourseError(f"{path}:{part.line}: the step '{part.title}' has no fence `step` with its conditions")
        id = re.sub(r"[^a-z0-9]+", "-", part.title.lower()).strip("-")
        found.append(Step(id, part.title, part.text(), tuple(part.snippets), tuple(part.conditions)))
    rows = [row for part in (head, *steps) for row in part.rows]
    return Chapter(head.title, head.text(), tuple(found), tuple(rows))


def _sections(path: Path, lines: Sequence[str]) -> list[_Section]:
    parts = [_Section("", 1)]
    fence, kind, about, start, body = "", "", "", 0, list[str]()
    for number, line in enumerate(lines, 1):
        found = FENCE.match(line)
        if fence:
            if found and line.strip() == fence:
                _add(parts[-1], kind, about, body, path, start)
                fence = ""
            else:
                body.append(line)
        elif found:
            fence, kind, about = found[1], found[2], found[3]
            start, body = number, []
        elif line.startswith("## "):
            parts.append(_Section(line[3:].strip(), number))
        elif line.startswith("# "):
            if parts[0].title:
                raise CourseError(f"{path}:{number}: a second `# Title`; put another chapter in a file of its own")
            parts[0].title, parts[0].line = line[2:].strip(), number
        else:
            parts[-1].prose.append(line)
    if fence:
        raise CourseError(f"{path}:{start}: this fence is not closed by {fence}")
    return parts


def _add(part: _Section, kind: str, about: str, body: Sequence[str], path: Path, line: int) -> None:
    try:
        if kind == "step":
            part.conditions += _conditions(body, line)
        elif kind == "grade":
            part.rows.append(read_grade_row(about, body, line))
        else:
            part.snippets.append(Snippet("\n".join(body), about if kind not in ("console", "bash", "sh") else ""))
    except ValueError as error:
        raise CourseError(f"{path}:{error}") from None


def _conditions(body: Sequence[str], line: int) -> Iterator[Condition]:
    for number, text in enumerate(body, line + 1):
        if text.strip() and not text.lstrip().startswith("#"):
            yield read_condition(text.strip(), number)
