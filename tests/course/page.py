"""The page's workspace with its unchanged listings, and a running system in which its commands are run."""

from __future__ import annotations

import os
import re
import shlex
import shutil
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple

from bot_console.runtime.workspace import discover
from course.rows import COURSE, Row, rows
from systems import Program, System, system

MANIFEST = """<?xml version="1.0"?>
<package format="3">
  <name>{name}</name><version>0.0.1</version><description>d</description>
  <maintainer email="a@b.c">a</maintainer><license>Apache-2.0</license>
  <export><build_type>ament_python</build_type></export>
</package>
"""
SETUP = """import os
from glob import glob
from setuptools import setup

package_name = 'my_package'
setup(
    name=package_name,
    packages=[package_name],
    data_files=[
        {data_files}
        (os.path.join('share', package_name, 'launch'), glob('launch/*.py')),
    ],
    entry_points={{'console_scripts': [{scripts}]}},
)
"""
SETUP_CFG = """[develop]
script_dir=$base/lib/{name}
[install]
install_scripts=$base/lib/{name}
"""
"""The file that `ros2 pkg create` writes; the page does not print it."""
DATA_FILES_ROW = 81
LOG = re.compile(r"^(?:\[\w+-\d+\] )?\[(\w+)\] \[\d{10}\.\d{9}\] \[([^\]]+)\]: (.*)$")
STATED = re.compile(r"^\[(\w+)\] (?:\[([^\]]+)\]: )?(.*)$")


class PrintedText(NamedTuple):
    """A log line: severity, logger, message; the page omits the time, and sometimes the logger (N2)."""

    severity: str
    logger: str
    message: str


def logs(program: Program) -> list[PrintedText]:
    """The log lines of a program, or of the nodes of a launch, in the format of real ROS 2 (N2)."""
    lines = "".join(text for _, text in program.output).splitlines()
    return [PrintedText(*match.groups()) for line in lines if (match := LOG.match(line))]


def stated(text: str) -> PrintedText:
    """Parse a log line as the page prints it."""
    match = STATED.match(text)
    assert match, f"{text!r} is no log line"
    return PrintedText(match[1], match[2] or "", match[3])


def message_of(program: Program, line: PrintedText) -> int:
    """Count how often a program has logged a line; a line without a logger matches any logger."""
    return sum(each == (line.severity, line.logger or each.logger, line.message) for each in logs(program))


class Page:
    """A running system in which the page's commands are run."""

    def __init__(self, running: System, scratch: Path) -> None:
        self._system = running
        self.scratch = scratch
        """A folder for files."""

    def row(self, number: int) -> Row:
        """A row by its number."""
        return rows()[number]

    def start(self, command: str, seconds: float = 0.5) -> Program:
        """Start the program of a command line and let it run for `seconds`."""
        program = self._start(command)
        self._system.run(seconds)
        return program

    def ask(self, command: str, stop_after: float | None = None) -> Program:
        """Run a command line to its end, or interrupt it after `stop_after` seconds."""
        return self._system.finish(self._start(command), stop_after)

    def stop(self, program: Program) -> Program:
        """Interrupt a program as Ctrl-C does."""
        return self._system.finish(program, 0.0)

    def run(self, seconds: float) -> None:
        """Let time (s) pass."""
        self._system.run(seconds)

    def python(self, text: str, seconds: float = 0.5) -> Program:
        """Start `python -c`, beside the page's node files."""
        program = self._system.python("-c", f"import sys; sys.path.insert(0, {str(COURSE / 'nodes')!r})\n{text}")
        self._system.run(seconds)
        return program

    def node_file(self, name: str, *words: str, seconds: float = 0.5) -> Program:
        """Start a node file of the page."""
        return self.start_file(COURSE / "nodes" / name, *words, seconds=seconds)

    def start_file(self, path: Path, *words: str, seconds: float = 0.5) -> Program:
        """Start any node file."""
        program = self._system.python(str(path), *words)
        self._system.run(seconds)
        return program

    def bot_console(self, *words: str) -> Program:
        """Run `bot-console ...` to its end."""
        from bot_console.tui.cli.main import main

        return self._system.finish(
            self._system.compose("bot-console", lambda: sys.exit(main(words)), ["bot-console", *words])
        )

    def value(self, node: str, parameter: str) -> str:
        """The output of `ros2 param get --hide-type`."""
        return self.ask(f"ros2 param get {node} {parameter} --hide-type").stdout.strip()

    def work_on(self, folder: Path) -> None:
        """Use the packages of another workspace for the rest of the test."""
        discover.use(discover.Workspace([folder / "src"]))

    def work_in(self, folder: str) -> None:
        """Change the working directory for the rest of the test."""
        os.chdir(folder)

    def _start(self, command: str) -> Program:
        words = shlex.split(command)
        assert words[0] == "ros2", command
        return self._system.ros2(*words[1:])


@contextmanager
def page(folder: Path, scratch: Path, *, own: bool = False) -> Iterator[Page]:
    """A system in the page's workspace; with `own`, in an empty workspace, so that our own robot is found."""
    before = discover.workspace()
    discover.use(discover.Workspace([] if own else [folder / "src"]))
    try:
        with system() as running:
            yield Page(running, scratch)
    finally:
        discover.use(before)


SHIM = """import rclpy

def main():
    rclpy.init()
    rclpy.spin(rclpy.create_node('stand_in', automatically_declare_parameters_from_overrides=True))
"""
NOT_PRINTED = {
    "my_package": ("sensor_processor", "controller", "path_planner", "motion_controller"),
    "intelligent_robot": ("sensor_node", "safety_node", "telemetry_node"),
}


def make_workspace(folder: Path, *, complete: bool = False) -> Path:
    """Create `src/my_package` and `src/intelligent_robot` with the page's files; `complete` adds substitutes (N8)."""
    _package(folder / "src" / "my_package", sorted((COURSE / "nodes").glob("*.py")))
    names = sorted(each.stem for each in (COURSE / "nodes").glob("*.py"))
    names += NOT_PRINTED["my_package"] if complete else ()
    scripts = ", ".join(f"'{each} = my_package.{each}:main'" for each in names)
    setup = SETUP.format(data_files=rows()[DATA_FILES_ROW].quoted[0], scripts=scripts)
    (folder / "src" / "my_package" / "setup.py").write_text(setup, "utf-8")
    robot = folder / "src" / "intelligent_robot"
    _package(robot, sorted((COURSE / "nodes" / "intelligent_robot").glob("*.py")))
    shutil.copy(COURSE / "setup.py.txt", robot / "setup.py")
    for package, modules in NOT_PRINTED.items() if complete else ():
        for each in modules:
            (folder / "src" / package / package / f"{each}.py").write_text(SHIM, "utf-8")
    return folder


def _package(folder: Path, modules: list[Path]) -> None:
    code = folder / folder.name
    code.mkdir(parents=True)
    (folder / "package.xml").write_text(MANIFEST.format(name=folder.name), "utf-8")
    (code / "__init__.py").touch()
    (folder / "setup.cfg").write_text(SETUP_CFG.format(name=folder.name), "utf-8")
    (folder / "resource").mkdir()
    (folder / "resource" / folder.name).touch()
    for each in modules:
        shutil.copy(each, code)
    for name in ("config", "launch"):
        shutil.copytree(COURSE / name, folder / name)
