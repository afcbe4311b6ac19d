"""Parsers of files: each function feeds a text to one of them."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

from messages import shown

FOLDER = Path(tempfile.mkdtemp(prefix="fuzz"))


def file(text: str, name: str) -> Path:
    """Write a file with this text; there is one file per name."""
    path = FOLDER / name
    path.write_bytes(text.encode("utf-8", "surrogatepass"))
    return path


def parameter_file(text: str) -> None:
    from bot_console.runtime.rmw.parameter_file import read_parameter_file
    from bot_console.runtime.rmw.parameter_overrides import ParameterOverrides

    read_parameter_file(str(file(text, "parameters.yaml")), ParameterOverrides())


def preset(text: str) -> None:
    from bot_console_robot.preset_files import read

    read(file(text, "preset.yaml").parent, "preset")


def profile(text: str) -> None:
    from bot_console.tui.console.parameters.profiles import differences, load

    profile = load(file(text, "profile.yaml"))
    differences(profile, trees())
    for value in profile.values.values():
        shown(value)


def save(text: str) -> None:
    from bot_console.tui.console.parameters.file.saving import save

    save(file(text, "saved.yaml"), trees())


@cache
def trees() -> Any:
    from bot_console.tui.console.model import Kind, ParameterInfo, ParameterTree

    values = [
        (Kind.DOUBLE, 0.5),
        (Kind.INTEGER, 3),
        (Kind.STRING, "a: b"),
        (Kind.BOOL, True),
        (Kind.DOUBLE_ARRAY, (1.0, 2.5)),
    ]
    names = ("max_speed", "count", "robot_name", "enabled", "weights.all")
    infos = tuple(ParameterInfo("/robot_navigator", name, *each) for name, each in zip(names, values, strict=True))
    return {"/robot_navigator": ParameterTree("/robot_navigator", infos)}


def world(text: str) -> None:
    from bot_console_robot.simulation.world_file import load_world

    load_world(file(text, "world.yaml"))


def launch(suffix: str) -> Callable[[str], None]:
    def run(text: str) -> None:
        from bot_console.tui.console.launch.fault import fault_text
        from launch.launch_description_sources import AnyLaunchDescriptionSource

        from launch import LaunchContext

        path = file(text, f"mutated.launch.{suffix}")
        try:
            found = AnyLaunchDescriptionSource(str(path)).get_launch_description(LaunchContext())
            found.get_launch_arguments()
        except Exception as error:  # any error is reported as one message
            assert fault_text(error, str(path), reading=True).strip()

    return run


def settings(text: str) -> None:
    from bot_console.tui.settings.settings import read_settings

    read_settings(file(text, "settings.yaml"))


def layout(suffix: str) -> Callable[[str], None]:
    def run(text: str) -> None:
        from bot_console.tui.settings.layouts import FileLayouts

        FileLayouts({"parameters", "logs", "plot"}).from_file(file(text, f"layout.{suffix}"))

    return run


def package(text: str) -> None:
    from bot_console.runtime.workspace.package import read_package

    file(text, "package.xml")
    read_package(FOLDER)


def plain_file(text: str) -> None:
    from bot_console.runtime.programs.python_file_check import examine

    examine(file(text, "node.py"))


def definition(kind: str) -> Callable[[str], None]:
    def run(text: str) -> None:
        from bot_console.runtime.rosidl.parse import parse
        from bot_console.runtime.rosidl.write import to_text

        interface = parse(text, "mine", kind, "Mutated")
        to_text(interface)

    return run
