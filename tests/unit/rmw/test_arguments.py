"""ROS arguments on command lines."""

from __future__ import annotations

import pytest
from bot_console.runtime.rmw.arguments import ArgumentsError, parse
from bot_console.runtime.rmw.parameter_scalars import scalar_value


@pytest.mark.parametrize(
    ("words", "unparsed", "unknown"),
    [
        ("prog", ["prog"], []),
        ("prog a --flag", ["prog", "a", "--flag"], []),
        ("prog --ros-args", ["prog"], []),
        ("prog --ros-args -- x --y", ["prog", "x", "--y"], []),
        ("prog --ros-args -p a:=1 -- w --ros-args -r a:=b", ["prog", "w"], []),
        ("prog --ros-args word", ["prog"], ["word"]),
        ("prog --ros-args a:=b", ["prog"], ["a:=b"]),
        ("prog --ros-args -x -p a:=1 --zz", ["prog"], ["-x", "--zz"]),
        ("prog --ros-args -pa:=1", ["prog"], ["-pa:=1"]),
        ("prog --", ["prog", "--"], []),
    ],
)
def test_ros_arguments_are_separated_from_others(words: str, unparsed: list[str], unknown: list[str]) -> None:
    parsed = parse(words.split())
    assert (parsed.unparsed, parsed.unknown_ros_args) == (unparsed, unknown)


def test_rule_outside_ros_args_is_applied_and_noted_as_deprecated() -> None:
    parsed = parse(["prog", "a:=b", "__node:=x", "a:=1"])
    assert parsed.deprecated_rules == ["a:=b", "__node:=x"]
    assert len(parsed.remap_rules) == 2
    assert parsed.unparsed == ["prog", "a:=1"]


@pytest.mark.parametrize(
    "name", ["a", "_a1", "a.b.c", "a/b", "/a", "a//b", "/", "a.b/c.d", "qos_overrides./t.publisher.depth"]
)
def test_parameter_names_are_accepted(name: str) -> None:
    assert parse(["--ros-args", "-p", f"{name}:=3"]).parameters.for_node("/n") == {name: 3}


@pytest.mark.parametrize(
    ("words", "error"),
    [
        (["-p"], "Couldn't parse trailing -p flag. No parameter override rule found."),
        (["--param"], "Couldn't parse trailing --param flag. No parameter override rule found."),
        (["-r"], "Couldn't parse trailing -r flag. No remap rule found."),
        (["--params-file"], "Couldn't parse trailing --params-file flag. No file path provided."),
        (["--log-level"], "Couldn't parse trailing log level flag: '--log-level'. No log level provided."),
        (["--log-config-file"], "Couldn't parse trailing --log-config-file flag. No file path provided."),
        (["--log-file-name"], "Couldn't parse trailing --log-file-name flag. No string prefix provided."),
        (["-e"], "Couldn't parse trailing -e flag. No enclave path provided."),
        (
            ["-p", "a"],
            "Couldn't parse parameter override rule: '-p a'. Error: "
            "Expected lexeme type (22) not found, search ended at index 1",
        ),
        (["-p", ":=1"], "Couldn't parse parameter override rule: '-p :=1'. Error: Expecting token or wildcard"),
        (["-p", "a.:=1"], "Couldn't parse parameter override rule: '-p a.:=1'. Error: Expecting token or wildcard"),
        (["-r", "a"], "Couldn't parse remap rule: '-r a'. Error: "
         "Expected lexeme type (19) not found, search ended at index 1"),
    ],
)  # fmt: skip
def test_invalid_ros_arguments_are_rejected(words: list[str], error: str) -> None:
    with pytest.raises(ArgumentsError) as caught:
        parse(["prog", "--ros-args", *words])
    assert str(caught.value) == error


@pytest.mark.parametrize(
    ("level", "default", "loggers"),
    [
        ("DEBUG", 10, {}),
        ("warn", 30, {}),
        ("Fatal", 50, {}),
        ("unset", 0, {}),
        ("n:=error", None, {"n": 40}),
        ("a.b:=debug", None, {"a.b": 10}),
        ("a-b c:=info", None, {"a-b c": 20}),
    ],
)
def test_log_levels_are_parsed(level: str, default: int | None, loggers: dict[str, int]) -> None:
    parsed = parse(["--ros-args", "--log-level", level])
    assert (parsed.default_level, parsed.logger_levels) == (default, loggers)


@pytest.mark.parametrize(
    ("level", "why"),
    [
        ("", "Argument does not use a valid severity level"),
        ("WARNING", "Argument does not use a valid severity level"),
        ("10", "Argument does not use a valid severity level"),
        ("n:=loud", "Argument does not use a valid severity level"),
        (":=warn", "Argument has an invalid logger item that name is empty"),
        ("n:=", "Expected lexeme type (18) not found, search ended at index 3"),
        ("n:=10", "Expected lexeme type (18) not found, search ended at index 3"),
        ("n:=m:=warn", "Expected lexeme type 1, got 8 at index 4"),
    ],
)
def test_invalid_log_levels_are_rejected(level: str, why: str) -> None:
    with pytest.raises(ArgumentsError) as caught:
        parse(["--ros-args", "--log-level", level])
    assert str(caught.value) == f"Couldn't parse log level: '--log-level {level}'. Error: {why}"


@pytest.mark.parametrize(
    ("flags", "stdout", "rosout", "external"),
    [
        ("", True, True, True),
        ("--disable-stdout-logs", False, True, True),
        ("--disable-rosout-logs --disable-external-lib-logs", True, False, False),
        ("--disable-stdout-logs --enable-stdout-logs", True, True, True),
    ],
)
def test_log_flags_select_outputs(flags: str, stdout: bool, rosout: bool, external: bool) -> None:
    parsed = parse(["--ros-args", *flags.split()])
    assert (parsed.stdout_enabled, parsed.rosout_enabled, parsed.external_logs_enabled) == (stdout, rosout, external)


def test_arguments_must_be_strings() -> None:
    with pytest.raises(TypeError):
        parse(["prog", 5])  # type: ignore[list-item]


def test_integer_of_any_length_is_read() -> None:
    assert scalar_value("9" * 5000) == "9" * 5000
    assert scalar_value("9223372036854775807") == 2**63 - 1
