"""`check WORKSPACE --course`: the reference solution passes, and each wrong variant fails in the row that it breaks."""

from __future__ import annotations

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple
from xml.etree import ElementTree

import pytest
from bot_console.tui.cli.check import grade as grading
from bot_console.tui.cli.check.grade import run_grading
from bot_console.tui.learn import sandbox
from bot_console.tui.learn.course import find_course, read_course
from bot_console.tui.learn.grade_row import read_grade_row
from bot_console.tui.learn.grading import RowResult, as_junit, grade, row_text, sum_text
from bot_console.tui.learn.sandbox import NoSandboxError, can_isolate, make_sandbox
from course.page import make_workspace
from course.rows import rows

needs_course = pytest.mark.skipif(not rows(), reason="BOT_CONSOLE_COURSE names no course")
needs_namespaces = pytest.mark.skipif(not can_isolate(), reason="programs get no namespaces of their own here")

FILES, PROGRAMS, LAUNCHES, DEFAULTS, VALID, SPEED, DISTANCE, THRESHOLD, NAME, SYSTEM, DRIVES = (
    each.title for each in read_course(find_course("week6")).rows() if not each.extra
)
NODE, SETUP = "intelligent_robot/robot_node.py", "setup.py"
CONFIG, LAUNCH = "config/indoor_config.yaml", "launch/robot_system.launch.py"
STARTED = (DEFAULTS, VALID, SPEED, DISTANCE, THRESHOLD, NAME)
"""Rows that start the robot node."""
ALL = (*STARTED, SYSTEM, DRIVES)

VARIANTS: list[tuple[str, str, str, tuple[str, ...]]] = [
    (CONFIG, "ros__parameters", "ros_parameters", (FILES, SYSTEM, DRIVES)),
    (CONFIG, "max_speed", "max_sped", (FILES,)),
    (SETUP, r"'\*?config'\),\s*glob\('config/\*\.yaml'\)", "'config'), []", (FILES, SYSTEM, DRIVES)),
    (SETUP, r"glob\('launch/\*\.py'\)", "[]", (LAUNCHES, SYSTEM, DRIVES)),
    (SETUP, r"'robot_node = .*", "", (PROGRAMS, *ALL)),
    (SETUP, r"'sensor_node = .*", "", (PROGRAMS, SYSTEM, DRIVES)),
    (SETUP, r"'safety_node = .*", "", (PROGRAMS, SYSTEM, DRIVES)),
    (SETUP, r"'telemetry_node = .*", "", (PROGRAMS, SYSTEM, DRIVES)),
    (NODE, r"'max_speed', 1\.0", "'max_speed', 1.5", (DEFAULTS,)),
    (NODE, r"'safety_distance', 0\.5", "'safety_distance', 0.6", (DEFAULTS,)),
    (NODE, r"'detection_threshold', 100", "'detection_threshold', 99", (DEFAULTS,)),
    (NODE, r"'turn_rate', 1\.0", "'turn_rate', 1.1", (DEFAULTS,)),
    (NODE, r"'turn_rate', 1\.0", "'turn_rate', 1", (SYSTEM, DRIVES)),
    (NODE, r"'max_speed', 1\.0", "'max_speed', 1", (VALID, SPEED, SYSTEM, DRIVES)),
    (NODE, r"'max_speed', 1\.0", "'maximum_speed', 1.0", ALL),
    (NODE, r"super\(\).__init__\('robot_navigator'\)", "super().__init__('navigator')", STARTED),
    (NODE, r"<= 5\.0", "<= 50.0", (SPEED,)),
    (NODE, r"if 0\.1 <= param.value <= 5\.0", "if param.value <= 5.0", (SPEED,)),
    (NODE, r"if 0\.1 <= param.value <= 5\.0", "if 0.1 <= param.value <= 1.5", (VALID,)),
    (NODE, r"<= 2\.0", "<= 20.0", (DISTANCE,)),
    (NODE, r"if 0\.1 <= param.value <= 2\.0", "if 0.1 <= param.value <= 0.7", (VALID,)),
    (NODE, r"<= 255", "<= 999", (THRESHOLD,)),
    (NODE, r"len\(param.value\) > 0", "True", (NAME,)),
    (NODE, r"        return result", "        return None", (VALID,)),
    (NODE, r"result.successful = False", "result.successful = True", (SPEED, DISTANCE, THRESHOLD, NAME)),
    (NODE, r"self.add_on_set_parameters_callback\(.*\)", "pass", (SPEED, DISTANCE, THRESHOLD, NAME)),
    (NODE, r"import rclpy\n", "import rclpyy\n", ALL),
    (NODE, r"twist.linear.x = self.max_speed", "twist.linear.x = 0.0", (DRIVES,)),
    (NODE, r"self.cmd_vel_pub.publish\(twist\)", "pass", (DRIVES,)),
    (LAUNCH, r"        telemetry_node\n", "", (SYSTEM,)),
    (LAUNCH, r"name='sensor_handler'", "name='sensors'", (SYSTEM,)),
    (LAUNCH, r"executable='safety_node'", "executable='safty_node'", (SYSTEM, DRIVES)),
    (LAUNCH, r"return LaunchDescription", "LaunchDescription", (SYSTEM, DRIVES)),
]
"""File, pattern, replacement, and the rows that depend on it; the first of these has to fail."""


def workspace(folder: Path) -> Path:
    return make_workspace(folder / "ws", complete=True)


def change(folder: Path, file: str, pattern: str, replacement: str) -> None:
    path = folder / "src" / "intelligent_robot" / file
    text, count = re.subn(pattern, replacement, path.read_text("utf-8"))
    assert count, f"{pattern} is not in {file}"
    path.write_text(text, "utf-8")


def failed(folder: Path, rows: set[str] | None = None) -> dict[str, str]:
    course = read_course(find_course("week6"))
    if rows is not None:
        chapters = tuple(_keep_rows(each, rows) for each in course.chapters)
        course = type(course)(course.name, course.title, chapters, course.defaults)
    return {each.row.title: each.why for each in grade(course, folder) if each.failed}


def _keep_rows(chapter: Any, rows: set[str]) -> Any:
    kept = tuple(each for each in chapter.rows if each.title in rows)
    return type(chapter)(chapter.title, chapter.text, chapter.steps, kept)


@needs_course
@needs_namespaces
@pytest.mark.soak
def test_reference_solution_passes_every_row(tmp_path: Path) -> None:
    assert failed(workspace(tmp_path)) == {}


@needs_course
@needs_namespaces
@pytest.mark.soak
@pytest.mark.parametrize(("file", "pattern", "replacement", "rows"), VARIANTS)
def test_wrong_variant_fails_only_in_rows_that_depend_on_it(
    file: str, pattern: str, replacement: str, rows: tuple[str, ...], tmp_path: Path
) -> None:
    folder = workspace(tmp_path)
    change(folder, file, pattern, replacement)
    found = failed(folder)
    assert rows[0] in found and set(found) <= set(rows), found


@needs_course
@needs_namespaces
@pytest.mark.slow
def test_wrong_default_fails_only_its_own_row(tmp_path: Path) -> None:
    folder = workspace(tmp_path)
    change(folder, NODE, r"'max_speed', 1\.0", "'max_speed', 1.5")
    found = failed(folder, {FILES, DEFAULTS, SPEED})
    assert set(found) == {DEFAULTS}
    assert found[DEFAULTS].startswith("expect /robot_navigator:max_speed == 1.0: ")


def course_of(folder: Path, row: str) -> Any:
    folder.mkdir()
    (folder / "course.md").write_text("# C\n", "utf-8")
    chapter = f"# One\n## S\n```step\nsaw-steering\n```\n```grade 1 Row\n{row}\n```\n"
    (folder / "1.md").write_text(chapter, "utf-8")
    return read_course(folder)


def grade_program(
    tmp_path: Path, program: str, row: str = "run {package} node\nexpect-node /never within 1 s"
) -> RowResult:
    place = tmp_path / "ws" / "src" / "mine"
    (place / "mine").mkdir(parents=True)
    (place / "package.xml").write_text(
        "<package><name>mine</name><export><build_type>ament_python</build_type></export></package>", "utf-8"
    )
    (place / "setup.py").write_text(
        "from setuptools import setup\nsetup(name='mine', packages=['mine'], "
        "entry_points={'console_scripts': ['node = mine.node:main']})\n", "utf-8"
    )  # fmt: skip
    (place / "mine" / "__init__.py").touch()
    (place / "mine" / "node.py").write_text(program, "utf-8")
    (result,) = grade(course_of(tmp_path / "course", row), tmp_path / "ws")
    return result


class Escape(NamedTuple):
    """What a program that tries to get out of its sandbox has achieved."""

    why: str
    place: Path
    running: str
    """The command lines of all processes after its row."""


@pytest.fixture(scope="module")
def escape(tmp_path_factory: pytest.TempPathFactory) -> Escape:
    """One graded row for all tests that examine its effects, since it starts whole sandboxes."""
    place = tmp_path_factory.mktemp("escape")
    program = (
        "import os, socket, subprocess\n"
        "def main():\n"
        "    open('src/mine/changed', 'w').close()\n"
        "    names = [name for _, name in socket.if_nameindex()]\n"
        "    print('interfaces', names, 'processes', len([p for p in os.listdir('/proc') if p.isdigit()]) < 20)\n"
        f"    subprocess.Popen(['sh', '-c', 'sleep 1000 # {place}/alive'], start_new_session=True)\n"
        "    print('started', flush=True)\n"
    )
    why = grade_program(place, program).why
    listed = subprocess.run(["ps", "-eo", "args"], capture_output=True, text=True, check=True)
    return Escape(why, place, listed.stdout)


@needs_namespaces
def test_graded_program_reaches_no_network_and_changes_no_file_of_the_workspace(escape: Escape) -> None:
    assert "interfaces ['lo'] processes True" in escape.why
    assert not (escape.place / "ws" / "src" / "mine" / "changed").exists()


@needs_namespaces
def test_nothing_that_a_graded_program_starts_outlives_its_row(escape: Escape) -> None:
    assert "started" in escape.why
    assert f"{escape.place}/alive" not in escape.running


@needs_namespaces
def test_child_processes_share_the_memory_limit(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sandbox, "MAX_MEMORY_BYTES", 150_000_000)
    monkeypatch.setattr(sandbox, "MEMORY_POLL_S", 0.02)
    box = make_sandbox(_empty(tmp_path), _new(tmp_path), allow_network=False)
    hog = f"{sys.executable} -c 'x = bytearray(90_000_000); input()'"
    done = box.run(f"sleep 60 | {hog} & sleep 60 | {hog} & wait", 60.0)
    assert done.why == "it used more than 150 MB of memory"


@needs_namespaces
def test_run_that_exceeds_its_time_limit_is_ended(tmp_path: Path) -> None:
    box = make_sandbox(_empty(tmp_path), _new(tmp_path), allow_network=False)
    assert box.run("trap '' TERM INT; sleep 1000", 0.3).why == "it took longer than 0.3 s"


def test_without_namespaces_grading_needs_consent(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sandbox, "can_isolate", lambda: False)
    with pytest.raises(NoSandboxError, match="--allow-network"):
        make_sandbox(_empty(tmp_path), _new(tmp_path), allow_network=False)
    assert make_sandbox(tmp_path / "empty", _new(tmp_path, "other"), allow_network=True).prefix == ()


def _empty(tmp_path: Path) -> Path:
    (tmp_path / "empty").mkdir()
    return tmp_path / "empty"


def _new(tmp_path: Path, name: str = "box") -> Path:
    (tmp_path / name).mkdir()
    return tmp_path / name


def test_pipes_and_sockets_are_not_copied_and_a_file_that_cannot_be_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    workspace = _empty(tmp_path)
    os.mkfifo(workspace / "pipe")
    (workspace / "link").symlink_to("nowhere")
    (workspace / "robot.py").touch()
    box = make_sandbox(workspace, _new(tmp_path), allow_network=True)
    assert sorted(os.listdir(box.workspace)) == ["link", "robot.py"]
    for error in (shutil.Error([("/w/a.py", "/copy/a.py", "denied")]), OSError(28, "denied")):

        def refuse(*_: object, error: OSError = error, **__: object) -> None:
            raise error

        monkeypatch.setattr(sandbox.shutil, "copytree", refuse)
        with pytest.raises(NoSandboxError, match=r"not graded, as /.* cannot be copied: .*denied"):
            make_sandbox(workspace, tmp_path / "other", allow_network=True)


@needs_namespaces
@pytest.mark.parametrize(
    "row",
    [
        "run {package} robot_node\nexpect-node /robot_navigator within 15 s",
        "drive 5 s {package} robot_system.launch.py > 0.1 m",
    ],
)
def test_installed_package_of_the_same_name_is_not_graded(row: str, tmp_path: Path) -> None:
    course = course_of(tmp_path / "course", row)
    course.defaults["package"] = "intelligent_robot"
    (result,) = grade(course, _empty(tmp_path))
    assert result.why == "there is no package yet: a folder with package.xml and setup.py"


@needs_namespaces
def test_file_conditions_are_graded_without_starting_anything(tmp_path: Path) -> None:
    result = grade_program(tmp_path, "", "expect-entry-point other")
    assert result.why == "src/mine/setup.py has no line for other in console_scripts"


def test_junit_report_has_a_case_per_row(tmp_path: Path) -> None:
    course = course_of(tmp_path / "c", "expect-file a.txt")
    (row,) = course.rows()
    suite = ElementTree.fromstring(as_junit(course, [RowResult(row, "not \x1b there"), RowResult(row, "")]))
    assert suite.attrib == {"name": "c", "tests": "2", "failures": "1", "skipped": "0"}
    failures = [each.find("failure") for each in suite]
    assert failures[0] is not None and failures[0].attrib["message"] == "not ? there"
    assert failures[1] is None


def test_extra_points_are_counted_separately_and_fail_nothing(tmp_path: Path) -> None:
    course = course_of(tmp_path / "c", "expect-file a.txt")
    (row,) = course.rows()
    extra = read_grade_row("+2 More", ["expect-file b.txt"], 1)
    results = [RowResult(row, ""), RowResult(extra, "not there")]
    assert row_text(results[1]).splitlines() == ["-     0/+2  More", "           not there"]
    assert sum_text(results) == "1 of 1 points, 0 of 2 extra points"
    suite = ElementTree.fromstring(as_junit(course, results))
    assert suite.attrib == {"name": "c", "tests": "2", "failures": "0", "skipped": "1"}
    assert [each.tag for case in suite for each in case] == ["skipped"]


@needs_namespaces
def test_command_prints_json_and_exits_with_1_when_a_row_fails(tmp_path: Path) -> None:
    course_of(tmp_path / "course", "expect-file a.txt")
    words = [
        sys.executable,
        "-m",
        "bot_console.tui",
        "check",
        str(_empty(tmp_path)),
        "--course",
        str(tmp_path / "course"),
    ]
    done = subprocess.run([*words, "--json"], capture_output=True, text=True, check=False)
    found = json.loads(done.stdout)
    assert (done.returncode, found["points"], found["rows"][0]["ok"]) == (1, 0, False)
    assert found["rows"][0]["why"] == "there is no file a.txt in the workspace"


def test_each_row_is_printed_as_soon_as_it_is_graded(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (row,) = course_of(tmp_path / "course", "expect-file a.txt").rows()
    printed: list[str] = []

    def two_rows(*_: object, **__: object) -> Iterator[RowResult]:
        yield RowResult(row, "not \x1b there")
        printed.append(capsys.readouterr().out)
        yield RowResult(row, "")

    monkeypatch.setattr(grading, "grade", two_rows)
    given = argparse.Namespace(
        script=str(tmp_path), course=str(tmp_path / "course"), json=False, junit="", allow_network=False
    )
    assert run_grading(given) == 1
    assert [each.splitlines()[0] for each in printed] == ["FAIL  0/1  Row"]
    assert capsys.readouterr().out.splitlines() == ["ok    1/1  Row", "1 of 2 points"]
