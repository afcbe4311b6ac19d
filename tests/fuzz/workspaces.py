"""Files of a workspace and of a course: each function feeds a text to the parser of one of them."""

from __future__ import annotations

import io
import re
import shutil
from collections.abc import Callable
from contextlib import redirect_stderr, redirect_stdout, suppress
from functools import cache
from pathlib import Path

from files import FOLDER, file


def chapter(text: str) -> None:
    """A chapter of a course."""
    from bot_console.tui.learn.course import read_course

    (FOLDER / "course").mkdir(exist_ok=True)
    file("# A course\nnode = talker\n", "course/course.md")
    file(text, "course/1.md")
    read_course(FOLDER / "course")


def check_script(text: str) -> None:
    from bot_console.tui.cli.check.script import read

    read(text)


def expected_graph(text: str) -> None:
    from bot_console.tui.console.graph.expected import differences, read
    from bot_console.tui.console.model import GraphInfo

    found = read(text)
    "".join(map(str, differences(found, GraphInfo(), {}))).encode("utf-8", "surrogatepass")


def editor_settings(text: str) -> None:
    """The settings of an editor, to which `setup editor` adds its own; the result can be read."""
    from bot_console.tui.files.jsonc import load, with_member, with_strings

    added = with_strings(with_member(text, "a", 1), "paths", ["/x", "/y"], lambda each: each.startswith("/old"))
    assert {"/x", "/y"} <= {each for each in load(added)["paths"] if isinstance(each, str)}


def build_file(name: str, reader: str) -> Callable[[str], None]:
    """The file that declares what a package installs."""

    def run(text: str) -> None:
        from importlib import import_module

        folder = FOLDER / "package"
        folder.mkdir(exist_ok=True)
        file(text, f"package/{name}")
        module, _, function = reader.rpartition(".")
        getattr(import_module(f"bot_console.runtime.workspace.{module}"), function)(folder)

    return run


def convert_options(text: str) -> None:
    """The options of `bag convert`, except for the output folder; refusals are those of the command."""
    from bot_console.tui.cli.bags import convert
    from bot_console.tui.console.bags.reader import Bag

    place = FOLDER / "converted"
    with suppress(OSError, ValueError, re.error), redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()):
        for each in convert._outputs(file(text, "convert.yaml")):
            shutil.rmtree(place, ignore_errors=True)
            convert._write([Bag(_bag())], {**each, "uri": str(place)})


@cache
def _bag() -> Path:
    """A bag with one message."""
    from bot_console.tui.console.bags.writer import BagWriter, WritingOptions
    from rclpy.serialization import serialize_message
    from std_msgs.msg import String

    writer = BagWriter(FOLDER / "one-message", WritingOptions(storage="mcap"))
    writer.topic("/chatter", String, [{"depth": 10}])
    writer.write("/chatter", serialize_message(String(data="a")), 10**9, 10**9)
    writer.close()
    return FOLDER / "one-message"


def qos_overrides(text: str) -> None:
    from bot_console.tui.console.bags.qos import read_overrides

    read_overrides(text)


def tuning(text: str) -> None:
    """A range, a name and a score, as `tune` takes them."""
    from bot_console.tui.tuning.score import parse_score
    from bot_console.tui.tuning.tunable import parse_range

    for parse in (parse_range, parse_score):
        try:
            parse(text)
        except ValueError as error:
            assert str(error)
