"""An exception carries the place in the launch where it was raised."""

from __future__ import annotations

import asyncio
from dataclasses import dataclass

import pytest
from launch.actions import IncludeLaunchDescription, LogInfo, OpaqueCoroutine, OpaqueFunction
from launch.invalid_launch_file_error import InvalidLaunchFileError
from launch.launch_description_sources import AnyLaunchDescriptionSource, PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration

from launch import LaunchContext, LaunchDescription, LaunchService


def failure_of(*entities):
    service = LaunchService(noninteractive=True)
    service.include_launch_description(LaunchDescription(list(entities)))
    assert service.run() == 1
    return service.failure


def place(error):
    reported = error.launch_place
    return reported.file, reported.line, reported.entity


def test_place_has_entity_and_its_source_line():
    action = LogInfo(msg=LaunchConfiguration("nowhere"))
    assert place(failure_of(action)) == (
        __file__,
        test_place_has_entity_and_its_source_line.__code__.co_firstlineno + 1,
        action,
    )


def test_innermost_entity_is_reported():
    inner = LogInfo(msg=LaunchConfiguration("nowhere"))
    outer = OpaqueFunction(function=lambda context: [inner])
    assert place(failure_of(outer))[2] is inner


def test_place_is_known_for_a_coroutine_that_fails_later():
    async def fails(context):
        await asyncio.sleep(0)
        raise RuntimeError("later")

    action = OpaqueCoroutine(coroutine=fails)
    file, line, entity = place(failure_of(action))
    assert (file, line, entity) == (
        __file__,
        test_place_is_known_for_a_coroutine_that_fails_later.__code__.co_firstlineno + 5,
        action,
    )


@dataclass(frozen=True)
class FrozenError(Exception):
    reason: str


def test_place_is_known_for_exceptions_without_attributes():
    def fails(context):
        raise FrozenError("so")

    action = OpaqueFunction(function=fails)
    assert place(failure_of(action))[2] is action


@pytest.mark.parametrize(
    ("name", "text", "line"),
    [
        ("a.launch.xml", "<launch>\n<log message='x'>\n</launch>", 3),
        ("a.launch.xml", "<launch>\n\n<nodel/>\n</launch>", 3),
        ("a.launch.xml", "<launch>\n<group>\n\n<log/>\n</group>\n</launch>", 4),
        ("a.launch.xml", "<robot>\n</robot>", 1),
        ("a.launch.yaml", "launch:\n- {a: b\n- c", 3),
        ("a.launch.yaml", "launch:\n- group:\n  - nodel: {}\n", 3),
        ("a.launch.py", "x = 1\n", None),
    ],
)
def test_place_is_the_line_of_a_syntax_error_in_the_file(tmp_path, name, text, line):
    path = tmp_path / name
    path.write_text(text)
    error = failure_of(IncludeLaunchDescription(AnyLaunchDescriptionSource(str(path))))
    while isinstance(error, InvalidLaunchFileError):
        error = error.__cause__
    assert place(error) == (str(path), line, None)


def test_place_of_a_missing_include_is_its_path():
    with pytest.raises(FileNotFoundError) as caught:
        PythonLaunchDescriptionSource("/nowhere/x.launch.py").get_launch_description(LaunchContext())
    assert place(caught.value) == ("/nowhere/x.launch.py", None, None)
