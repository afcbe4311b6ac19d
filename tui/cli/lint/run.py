"""The `lint` command: checks a file, a package, a folder, or running nodes."""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Iterable, Iterator
from pathlib import Path

from bot_console.runtime.importer import install
from bot_console.runtime.workspace.builtin_package import NAME, own_package
from bot_console.runtime.workspace.discover import workspace
from bot_console.runtime.workspace.package import read_package
from bot_console.tui.cli.lint.finding import LintFinding
from bot_console.tui.cli.lint.launch_file import dead_parameters, folder_of_package, missing_return
from bot_console.tui.cli.lint.launch_packages import unknown_packages
from bot_console.tui.cli.lint.packaging import defects, obstacles
from bot_console.tui.cli.lint.parameter_declarations import DeclaredNames
from bot_console.tui.cli.lint.parameter_declarations import lint as lint_python
from bot_console.tui.cli.lint.parameter_file import dead_values, looks_like_parameter_file, rejections
from bot_console.tui.console.parameters.descriptor_faults import faults
from bot_console.tui.session.embedded.reaching import reach_system
from bot_console.tui.text.counted import counted

INDEX = "course.md"
"""The file that makes a folder a course."""
XML_LAUNCH = (".launch.xml", "_launch.xml")
HERE_ONLY, NOWHERE = "works here, but not on ROS 2", "works nowhere"
"""Kinds of faults of packages."""
READ_TIMEOUT_S = 5.0
"""Seconds to read the parameters of running nodes."""


def run(words: list[str]) -> int:
    """Run the checks; 0 if nothing was found, 1 if something was, 2 for wrong usage."""
    parser = argparse.ArgumentParser(
        "bot-console lint",
        description="Find parameters without a description, range, unit or validation, and values that are never used.",
        epilog="exit codes: 0 nothing found, 1 something found, 2 wrong usage",
    )
    parser.add_argument(
        "what",
        nargs="?",
        default=".",
        metavar="PACKAGE | FILE | FOLDER | COURSE | running",
        help="what to check; `running`: the running nodes (default: this folder)",
    )
    parser.add_argument(
        "--json",
        action="store_true",
        help="print the findings as JSON (use `hint`: its former name `mend` will be removed in the next release)",
    )
    given = parser.parse_args(words)
    if (Path(given.what) / INDEX).is_file():
        return _course(Path(given.what))
    problem, found = _running() if given.what == "running" else _file_findings(given.what)
    if problem:
        print(problem, file=sys.stderr)
        return 2
    if given.json:
        fields = ("place", "line", "fault", "subject", "hint")
        # `hint` was called `mend` in earlier releases; that name is written for one more release.
        rows = [{name: getattr(each, name) for name in fields} | {"mend": each.hint} for each in found]
        print(json.dumps(rows, indent=2))
    else:
        for each in found:
            print(each.text())
        print(f"{len(found)} found" if found else "nothing found", file=sys.stderr)
    return 1 if found else 0


def _course(folder: Path) -> int:
    from bot_console.tui.learn.course import CourseError, read_course

    try:
        course = read_course(folder)
    except CourseError as error:
        print(error)
        return 1
    chapters, steps = counted(len(course.chapters), "chapter"), counted(len(course.steps()), "step")
    rows = counted(len(course.rows()), "row")
    print(f"nothing found in {chapters}, {steps} and {rows} of grading", file=sys.stderr)
    return 0


def _file_findings(what: str) -> tuple[str, list[LintFinding]]:
    files = files_of(what)
    if not files and not Path(what, "package.xml").is_file():
        return f"there is no file, folder or package '{what}' with Python or YAML files in it", []
    if files != [Path(what)]:
        found = lint_files(files)
        lines = {(each.place, each.line) for each in found}  # a setup.py that is not valid Python is known already
        others = [each for each in _package_findings(files, Path(what)) if each.fault != NOWHERE or
                  (each.place, each.line) not in lines]  # fmt: skip
        return "", sorted([*found, *others])
    # The parameters that a single file gives to nodes are compared with those that its package declares.
    package = folder_of_package(files[0])
    beside = [each for each in files_of(str(package)) if each.resolve() != files[0].resolve()] if package else []
    found = lint_files([*(each for each in beside if each.suffix == ".py"), *files], files[0])
    return "", [each for each in found if each.place == str(files[0])]


def _package_findings(files: Iterable[Path], where: Path) -> Iterator[LintFinding]:
    """The problems that keep the packages of these files from working on ROS 2."""
    install()
    folders = {folder for each in files if (folder := folder_of_package(each)) is not None}
    named = where.resolve()
    folders |= {named} if (where / "package.xml").is_file() else set()
    for folder in folders:
        package = read_package(folder)
        found = [*((HERE_ONLY, each) for each in obstacles(package)), *((NOWHERE, each) for each in defects(package))]
        for fault, each in found:
            # Paths are relative to the folder as the user named it, like those of the other findings.
            file = where / each.file.relative_to(named) if named in each.file.parents else each.file
            yield LintFinding(str(file), each.line, fault, each.problem, each.fix)


def files_of(what: str) -> list[Path]:
    """The Python, YAML and XML launch files that an argument stands for."""
    path = Path(what)
    if path.is_file():
        return [path]
    if not path.is_dir():
        install()
        package = own_package() if what == NAME else workspace().packages.get(what)
        if package is None:
            return []
        path = package.folder
    return sorted(
        each
        for each in path.rglob("*")
        if each.is_file()  # a pipe would never end
        and (each.suffix in (".py", ".yaml", ".yml") or each.name.endswith(XML_LAUNCH))
        and "test" not in each.parts
        and not any(part.startswith(".") for part in each.relative_to(path).parts)  # hidden folders such as `.venv`
    )


def lint_files(files: Iterable[Path], named: Path | None = None) -> list[LintFinding]:
    """The faults of files; parameter and launch files are compared with the names that the Python files declare.

    `named` is a file that the user has named; it counts as a parameter file, whatever its content.
    """
    found: list[LintFinding] = []
    declared = DeclaredNames()
    parameters: list[Path] = []
    launches: list[Path] = []
    for path in files:
        if path.name.endswith(XML_LAUNCH):
            found += unknown_packages(path)
            continue
        if path.suffix != ".py":
            parameters += [path] if looks_like_parameter_file(path) or path == named else []
            continue
        try:
            own, names = lint_python(path)
        except (SyntaxError, UnicodeDecodeError, OSError) as error:
            found.append(LintFinding(str(path), getattr(error, "lineno", None) or 0, *_unreadable(error)))
            declared.whole = False
            continue
        found += own
        if path.stem.endswith("launch"):
            launches.append(path)
            found += [*unknown_packages(path), *missing_return(path)]
        declared.nodes |= names.nodes
        declared.parameters |= names.parameters
        declared.whole = declared.whole and names.whole
    for path in parameters:
        problems = [*rejections(path)]
        found += problems
        if declared.nodes and not problems:
            found += dead_values(path, declared)
    for path in launches if declared.parameters and declared.whole else ():
        found += dead_parameters(path, frozenset(declared.parameters))
    return sorted(found)


def _unreadable(error: SyntaxError | UnicodeDecodeError | OSError) -> tuple[str, str, str]:
    """The fault, subject and hint for a Python file that cannot be read."""
    if isinstance(error, SyntaxError):
        return "the file is not valid Python", error.msg, "correct it, then run lint again"
    if isinstance(error, UnicodeDecodeError):
        return "the file cannot be read", "not UTF-8", "save it as UTF-8, then run lint again"
    return "the file cannot be read", error.strerror or str(error), "check its permissions"


def _running() -> tuple[str, list[LintFinding]]:
    install()
    if unreachable := reach_system():
        return unreachable, []
    from bot_console.tui.console.ros_console import RosConsole

    console = RosConsole()
    console.start()
    try:
        console.wait_ready(READ_TIMEOUT_S)
        deadline, known, still = time.monotonic() + READ_TIMEOUT_S, 0, 0
        while time.monotonic() < deadline and (still < 5 or not known):
            time.sleep(0.1)
            count = sum(len(tree.parameters) for tree in console.snapshot().parameters.values())
            known, still = count, still + 1 if count == known else 0
        trees = console.snapshot().parameters
    finally:
        console.close()
    if not trees:
        return "no node with parameters was found in this ROS domain", []
    return "", sorted(
        LintFinding(node, 0, fault, each.name)
        for node, tree in trees.items()
        for each in tree.parameters
        for fault in faults(each)
    )
