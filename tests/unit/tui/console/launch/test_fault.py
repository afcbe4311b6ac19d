"""Why a launch file cannot be run, with and without launch's record of its current action."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest
from bot_console.tui.console.launch import fault
from bot_console.tui.console.launch.fault import fault_text
from launch.invalid_launch_file_error import InvalidLaunchFileError
from launch.launch_description_sources import AnyLaunchDescriptionSource
from launch.launch_place import ATTRIBUTE, LaunchPlace

from launch import LaunchContext

ASKED = "/robot/asked.launch.py"
LIBRARY = ast.__file__


def with_place(error: Exception, file: str, line: int | None, entity: object = None) -> Exception:
    setattr(error, ATTRIBUTE, LaunchPlace(file, line, entity))
    return error


def as_upstream(error: BaseException) -> BaseException:
    """An exception as raised by a launch that attaches no record to it."""
    if error.__cause__ is not None:
        as_upstream(error.__cause__)
    error.__dict__.pop(ATTRIBUTE, None)
    return error


def read_error(path: Path, text: str) -> BaseException:
    path.write_text(text)
    with pytest.raises(InvalidLaunchFileError) as caught:
        AnyLaunchDescriptionSource(str(path)).get_launch_description(LaunchContext())
    return caught.value


def test_place_recorded_by_launch_is_used():
    assert fault_text(with_place(ValueError("no"), "/a.launch.xml", 7), ASKED) == "/a.launch.xml, line 7: no"
    assert fault_text(with_place(ValueError("no"), "/a.launch.xml", None), ASKED) == "/a.launch.xml: no"
    assert fault_text(ValueError("no"), ASKED) == f"{ASKED}: no"


def test_an_error_in_a_library_is_reported_in_the_launch_file_that_uses_it():
    entity = object()
    error = with_place(ValueError("no"), LIBRARY, 7, entity)
    assert fault_text(error, ASKED, lambda asked: "/uses.launch.py" if asked is entity else "") == "/uses.launch.py: no"
    assert fault_text(error, ASKED) == f"{ASKED}: no"


def test_an_unreadable_installed_launch_file_is_reported_itself():
    assert fault_text(with_place(ValueError("no"), LIBRARY, 7), ASKED) == f"{LIBRARY}, line 7: no"


def test_place_comes_from_the_traceback_if_launch_records_nothing(tmp_path):
    path = tmp_path / "a.launch.py"
    error = as_upstream(read_error(path, "\n\n1 / 0\n"))
    assert fault_text(error, ASKED) == f"{path}, line 3: ZeroDivisionError: division by zero"


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [("a.launch.xml", "<launch>\n<", "line 2: "), ("a.launch.yaml", "launch:\n- {a", "line 2: ")],
)
def test_a_parsers_line_belongs_to_the_requested_file_only_while_that_is_read(tmp_path, name, text, message):
    error = as_upstream(read_error(tmp_path / name, text))
    assert fault_text(error, ASKED, reading=True).startswith(f"{ASKED}, {message}")
    assert fault_text(error, ASKED).startswith(f"{ASKED}: ")


def test_no_private_attribute_and_no_frame_is_read():
    tree = ast.parse(Path(fault.__file__).read_text())
    names = {node.attr for node in ast.walk(tree) if isinstance(node, ast.Attribute)}
    names |= {node.value for node in ast.walk(tree) if isinstance(node, ast.Constant) and isinstance(node.value, str)}
    assert not {"f_locals", "tb_frame", "tb_next"} & names
    assert not [each for each in names if each.startswith("_") and not each.startswith("__")]
