"""`ros2 launch`: output and exit codes. Contract, section 3."""

from __future__ import annotations

import errno
import io
import os
import re
import signal
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

import pytest
from bot_console.runtime.programs.hints import SHOW
from ros2cli.command_line import main
from ros2cli.launch_print import print_description, print_resolved, show_args

LISTED = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, GroupAction, TimerAction
from launch.conditions import IfCondition
from launch.substitutions import EnvironmentVariable


def generate_launch_description():
    return LaunchDescription(
        [
            DeclareLaunchArgument("speed", default_value="1.0", description="Robot maximum speed in m/s"),
            DeclareLaunchArgument("nodef"),
            GroupAction([DeclareLaunchArgument("cond", default_value="z")], condition=IfCondition("true")),
            DeclareLaunchArgument("path", default_value=[EnvironmentVariable("HOME"), "/x"]),
            DeclareLaunchArgument("speed", default_value="2.0"),
            TimerAction(period=1.0, actions=[DeclareLaunchArgument("later", default_value="1")]),
        ]
    )
"""
SHOWN = """Arguments (pass arguments as '<name>:=<value>'):

    'speed':
        Robot maximum speed in m/s
        (default: '1.0')

    'nodef':
        no description given

    'cond':*
        no description given
        (default: 'z')

    'path':
        no description given
        (default: EnvVar('HOME') + '/x')

    'later':*
        no description given
        (default: '1')

* argument(s) which are only used if specific conditions occur
"""
OUTPUTS = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, LogInfo
from launch.substitutions import LaunchConfiguration


def generate_launch_description():
    return LaunchDescription([DeclareLaunchArgument("x", default_value="-"), LogInfo(msg=LaunchConfiguration("x"))])
"""
EMPTY = "from launch import LaunchDescription\ndef generate_launch_description():\n    return LaunchDescription()\n"


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An installed package `pkg` with two launch files of the same name, and launch files in the working directory."""
    import launch.logging

    share = tmp_path / "share" / "pkg"
    index = tmp_path / "share" / "ament_index" / "resource_index" / "packages"
    for place in (index, share / "launch" / "sub", share / "a", share / "b"):
        place.mkdir(parents=True)
    (index / "pkg").write_text("")
    (share / "launch" / "sub" / "deep.launch.py").write_text(OUTPUTS)
    for place in ("a", "b"):
        (share / place / "same.launch.py").write_text(OUTPUTS)
    for name, text in (("listed", LISTED), ("says", OUTPUTS), ("empty", EMPTY)):
        (tmp_path / f"{name}.launch.py").write_text(text)
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "log"))
    monkeypatch.chdir(tmp_path)
    launch.logging.reset()
    return tmp_path


@pytest.fixture(autouse=True)
def interrupts() -> Iterator[None]:
    """Restores the handling of interrupts that a launch changed."""
    before = signal.getsignal(signal.SIGINT)
    yield
    signal.signal(signal.SIGINT, before)


def run_ros2_launch(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str, str]:
    code = main(["launch", *words])
    found = capsys.readouterr()
    return code, found.out, found.err


def user_lines(text: str) -> list[str]:
    prefix = "[INFO] [launch.user]: "
    return [each.removeprefix(prefix) for each in text.splitlines() if each.startswith(prefix)]


@pytest.mark.parametrize("option", ["-s", "--show-args", "--show-arguments"])
def test_show_args_lists_arguments_with_defaults(capsys: pytest.CaptureFixture[str], option: str) -> None:
    assert run_ros2_launch(capsys, "listed.launch.py", option) == (0, SHOWN, "")


def test_show_args_reports_no_arguments(capsys: pytest.CaptureFixture[str]) -> None:
    shown = "Arguments (pass arguments as '<name>:=<value>'):\n\n  No arguments.\n"
    assert run_ros2_launch(capsys, "empty.launch.py", "-s") == (0, shown, "")


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["x:=1"], ["1"]),
        (["x:=1", "x:=2"], ["2"]),
        (["x:=a:=b"], ["a:=b"]),
        (["x:=a b"], ["a b"]),
        ([], ["-"]),
        (["unknown:=1"], ["-"]),
    ],
)
def test_launch_arguments_are_passed(capsys: pytest.CaptureFixture[str], words: list[str], message: list[str]) -> None:
    code, out, err = run_ros2_launch(capsys, "says.launch.py", *words)
    assert (code, user_lines(out), err) == (0, message, "")


@pytest.mark.parametrize("word", ["x", "x:=", ":=y"])
def test_malformed_argument_is_rejected(capsys: pytest.CaptureFixture[str], word: str) -> None:
    message = f"malformed launch argument '{word}', expected format '<name>:=<value>'\n"
    assert run_ros2_launch(capsys, "says.launch.py", word) == (1, "", message)


def test_launch_file_is_found_in_a_package(capsys: pytest.CaptureFixture[str]) -> None:
    code, out, _ = run_ros2_launch(capsys, "pkg", "deep.launch.py", "x:=1")
    assert (code, user_lines(out)) == (0, ["1"])


def test_missing_packages_and_files_are_reported(capsys: pytest.CaptureFixture[str], folder: Path) -> None:
    share = folder / "share" / "pkg"
    where = "in the share directory of package 'pkg'"
    rows: list[tuple[list[str], str]] = [
        (["nopkg", "x"], f"Package 'nopkg' not found: \"package 'nopkg' not found, searching: ['{folder}']\""),
        (["pkg", "zz.launch.py"], f"file 'zz.launch.py' was not found {where} which is at '{share}'"),
    ]
    for words, message in rows:
        assert run_ros2_launch(capsys, *words) == (1, "", message + "\n")
    code, _, err = run_ros2_launch(capsys, "pkg", "same.launch.py")
    assert code == 1
    assert err.startswith(f"file 'same.launch.py' was found more than once {where}: [")


def test_package_without_file_name_lists_its_launch_files(capsys: pytest.CaptureFixture[str], folder: Path) -> None:
    empty = folder / "share" / "empty"
    empty.mkdir()
    marker = folder / "share" / "ament_index" / "resource_index" / "packages" / "empty"
    marker.touch()
    code, _, err = run_ros2_launch(capsys, "pkg")
    assert code == 1 and err.startswith("name a launch file of package 'pkg': ") and "deep.launch.py" in err
    assert run_ros2_launch(capsys, "empty") == (
        1,
        "",
        "package 'empty' has no launch files; they are in its folder launch/, and setup.py installs them\n",
    )


@pytest.mark.parametrize("path", ["./x.launch.py", "x.launch.py", "share/"])
def test_mistyped_path_is_reported_as_invalid_package_name(capsys: pytest.CaptureFixture[str], path: str) -> None:
    code, _, err = run_ros2_launch(capsys, path)
    assert code == 1
    assert err.splitlines()[-1] == f"ValueError: '{path}' is not a valid package name"


@pytest.mark.parametrize(
    ("path", "expected"),
    [
        ("./other.launch.xml", "there is no launch file ./other.launch.xml"),
        ("sayz.launch.py", "there is no launch file sayz.launch.py; did you mean says.launch.py?"),
        ("no/says.launch.py", "there is no launch file no/says.launch.py"),
        ("share/", "share/ is a folder; name a launch file in it, or a package and its launch file"),
    ],
)
def test_mistyped_path_is_one_line_for_a_person(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, path: str, expected: str
) -> None:
    monkeypatch.setenv(SHOW, "1")
    assert run_ros2_launch(capsys, path) == (1, "", f"{expected}\n")


def test_invalid_options_show_usage(capsys: pytest.CaptureFixture[str]) -> None:
    for words, message in (
        (["says.launch.py", "-s", "x:=1"], "unrecognized arguments: x:=1"),
        (["says.launch.py", "-s", "-p"], "not allowed with argument"),
        ([], "the following arguments are required"),
    ):
        code, _, err = run_ros2_launch(capsys, *words)
        assert code == 2
        assert message in err


@pytest.mark.parametrize("show", [show_args, print_description, partial(print_resolved, arguments={})])
def test_write_error_is_not_blamed_on_the_launch_file(
    monkeypatch: pytest.MonkeyPatch, folder: Path, show: Callable[[str], int]
) -> None:
    class Full(io.StringIO):
        def write(self, _: str) -> int:
            raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("sys.stdout", Full())
    with pytest.raises(OSError):
        show("says.launch.py")


def test_prefix_filter_needs_a_prefix(capsys: pytest.CaptureFixture[str]) -> None:
    message = "--launch-prefix must be specified if --launch-prefix-filter is provided\n"
    assert run_ros2_launch(capsys, "says.launch.py", "--launch-prefix-filter", "x") == (1, "", message)


def test_print_shows_the_launch_description(capsys: pytest.CaptureFixture[str], folder: Path) -> None:
    (folder / "p.launch.py").write_text(
        "from launch import LaunchDescription\n"
        "from launch.actions import *\n"
        "from launch.event_handlers import OnProcessExit\n"
        "def generate_launch_description():\n"
        "    return LaunchDescription([LogInfo(msg='a'), ExecuteProcess(cmd=['b'], cwd='/tmp', shell=True),\n"
        "        RegisterEventHandler(OnProcessExit(on_exit=[LogInfo(msg='c'), Shutdown()]))])\n"
    )
    code, out, _ = run_ros2_launch(capsys, "p.launch.py", "--print")
    lines = out.splitlines()
    assert code == 0
    assert lines[0].startswith("<launch.launch_description.LaunchDescription object at 0x")
    assert lines[1:3] == ["├── LogInfo('a')", "├── ExecuteProcess(cmd=['b'], cwd=''/tmp'', env=None, shell=True)"]
    assert lines[3].startswith(
        "└── RegisterEventHandler('<launch.event_handlers.on_process_exit.OnProcessExit object at"
    )
    assert lines[4:] == [
        "    ├── OnProcessExit(matcher='event == ProcessExited', handler='<actions>', handle_once=False)",
        "        ├── LogInfo('c')",
        "        └── EmitEvent(event='launch.events.Shutdown')",
    ]


def test_print_of_an_empty_file_is_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    code, out, _ = run_ros2_launch(capsys, "empty.launch.py", "-p")
    assert (code, len(out.splitlines())) == (0, 1)


BAD: list[tuple[str, int, str]] = [
    ("x = 1", 1, "does not contain the required function 'generate_launch_description()'"),
    ("def generate_launch_description(): pass", 1, "'NoneType' object has no attribute"),
    ("def generate_launch_description(): return", 1, "generate_launch_description() returns nothing: end it with"),
    ("def generate_launch_description(): return []", 1, "generate_launch_description() returns a list: end it with"),
    ("import sys; sys.exit(7)", 7, ""),
    ("def f(:", 1, "SyntaxError"),
    ("import no_such_module", 1, "No module named 'no_such_module'"),
    ("raise ValueError('at import')", 1, "at import"),
]


@pytest.mark.parametrize(("text", "code", "message"), BAD, ids=[row[0] for row in BAD])
@pytest.mark.parametrize("option", [[], ["-s"], ["-p"]], ids=["run", "-s", "-p"])
def test_invalid_launch_files_are_reported_without_traceback(
    capsys: pytest.CaptureFixture[str], folder: Path, text: str, code: int, message: str, option: list[str]
) -> None:
    (folder / "bad.launch.py").write_text(text)
    found, out, err = run_ros2_launch(capsys, "bad.launch.py", *option)
    assert found == code
    assert message in out + err
    assert "Traceback" not in out + err


FAILING = [
    ("bad.launch.xml", '<launch>\n  <log message="$(var nope)"/>\n</launch>', 2),
    ("bad.launch.xml", "<launch>\n\n  <timer/>\n</launch>", 3),
    ("bad.launch.yaml", "launch:\n- log: {message: hi}\n- log: {massage: hi}\n", 3),
    ("bad.launch.py", "def helper():\n    nope\n\ndef generate_launch_description():\n    helper()\n", 2),
    ("bad.launch.py", "import os\ndef f(:\n", 2),
]


@pytest.mark.parametrize(("name", "text", "line"), FAILING)
def test_person_sees_where_a_launch_failed(
    capsys: pytest.CaptureFixture[str], folder: Path, monkeypatch: pytest.MonkeyPatch, name: str, text: str, line: int
) -> None:
    (folder / name).write_text(text)
    assert "failed at" not in run_ros2_launch(capsys, name)[2]
    monkeypatch.setenv(SHOW, "1")
    assert re.search(rf"^the launch failed at \S*{re.escape(name)}:{line}$", run_ros2_launch(capsys, name)[2], re.M)


def test_show_all_output_option_shows_quiet_processes(
    capsys: pytest.CaptureFixture[str], folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("OVERRIDE_LAUNCH_PROCESS_OUTPUT", "")
    (folder / "q.launch.py").write_text(
        "from launch import LaunchDescription\nfrom launch.actions import ExecuteProcess\n"
        "def generate_launch_description():\n    return LaunchDescription([ExecuteProcess(cmd=['echo', 'quiet'])])\n"
    )
    assert "] quiet" not in run_ros2_launch(capsys, "q.launch.py")[1]
    assert "] quiet" in run_ros2_launch(capsys, "q.launch.py", "-a")[1]
    assert os.environ["OVERRIDE_LAUNCH_PROCESS_OUTPUT"] == "both"


def test_screen_format_comes_from_the_environment(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    import launch.logging

    monkeypatch.setenv("OVERRIDE_LAUNCH_SCREEN_FORMAT", "{levelname}|{name}|{msg}")
    launch.logging.reset()
    assert "INFO|launch.user|-" in run_ros2_launch(capsys, "says.launch.py")[1].splitlines()


def test_debug_option_logs_more(capsys: pytest.CaptureFixture[str]) -> None:
    _, out, _ = run_ros2_launch(capsys, "says.launch.py", "-d")
    assert "[DEBUG]" in out


def test_exit_code_reflects_the_outcome(capsys: pytest.CaptureFixture[str], folder: Path) -> None:
    template = (
        "from launch import LaunchDescription\nfrom launch.actions import *\nfrom launch.conditions import *\n"
        "def generate_launch_description():\n    return LaunchDescription([{}])\n"
    )
    rows: list[tuple[str, int]] = [
        ("ExecuteProcess(cmd=['false'])", 0),
        ("ExecuteProcess(cmd=['false'], on_exit=Shutdown())", 0),
        ("ExecuteProcess(cmd=['/no/such'])", 0),
        ("LogInfo(msg='a', condition=IfCondition('yes'))", 1),
        ("OpaqueFunction(function=lambda context: 1 / 0)", 1),
    ]
    for text, code in rows:
        (folder / "e.launch.py").write_text(template.format(text))
        assert run_ros2_launch(capsys, "e.launch.py")[0] == code, text


RESOLVED = """
<launch>
  <arg name="speed" default="1"/>
  <log message="never" if="false"/>
  <set_parameter name="everywhere" value="yes"/>
  <group>
    <push_ros_namespace namespace="fleet"/>
    <node exec="true" name="worker">
      <param name="speed" value="$(var speed)"/>
      <param from="{file}"/>
      <remap from="a" to="b"/>
    </node>
  </group>
  <timer period="1.0"><log message="later"/></timer>
</launch>
"""


def test_print_resolved_shows_evaluated_nodes(capsys: pytest.CaptureFixture[str], folder: Path) -> None:
    (folder / "f.yaml").write_text("/**:\n  ros__parameters: {speed: 2.5, names: [a, b]}\n")
    path = folder / "r.launch.xml"
    path.write_text(RESOLVED.format(file=folder / "f.yaml").lstrip())
    code, out, err = run_ros2_launch(capsys, "--print", "--resolved", str(path), "speed:=7")
    assert code == 0, err
    assert out.splitlines() == [
        f"include {path}",
        "  speed = '7'",
        "  argument speed = '7' (given)",
        "  LogInfo (left out: its condition is false)",
        "  SetParameter",
        "  GroupAction",
        "    PushLaunchConfigurations",
        "    PushEnvironment",
        "    PushROSNamespace",
        f"    node /fleet/worker: true  [{path}:7]",
        "      remap a -> b",
        "      parameter everywhere = True  (bool, set by name)",
        f"      parameter names = ['a', 'b']  (string_array, {folder}/f.yaml)",
        "      parameter speed = 7  (integer, launch file)",
        "    PopEnvironment",
        "    PopLaunchConfigurations",
        "  TimerAction",
        "    1.0 seconds pass without being canceled:",
        "      LogInfo",
    ]


def test_resolved_needs_print(capsys: pytest.CaptureFixture[str]) -> None:
    assert run_ros2_launch(capsys, "--resolved", "says.launch.py") == (1, "", "--resolved goes with --print\n")


def test_first_interrupt_after_the_launch_is_ignored_and_second_ends_program(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert run_ros2_launch(capsys, "empty.launch.py")[0] == 0
    signal.raise_signal(signal.SIGINT)
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)
