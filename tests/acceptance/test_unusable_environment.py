"""A command that cannot work where it is says so in one line: a full disk, a deleted folder, an unwritable home."""

from __future__ import annotations

import io
import os
import subprocess
import sys
from pathlib import Path

import pytest
from bot_console.runtime.programs.exit_messages import run_and_report
from bot_console.tui.console.model import ProcessState
from bot_console.tui.session.embedded.child_host import start_host
from bot_console.tui.session.embedded.workspaces import PROGRAM_LAUNCH
from bot_console.tui.session.launch_host.proxy import HostedLauncher
from launcher_bench import WAITS

TIMEOUT_S = 240.0
"""Seconds of wall time after which a hanging command fails its test."""


def command(words: list[str], folder: Path, **options: object) -> subprocess.CompletedProcess[str]:
    program = [sys.executable, "-c", "from bot_console.tui.cli.main import program; program()", *words]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path), **options.pop("env", {})}
    return subprocess.run(
        program,
        cwd=folder,
        env=environment,
        stderr=subprocess.PIPE,
        text=True,
        timeout=TIMEOUT_S,
        check=False,
        **options,
    )


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs /dev/full")
@pytest.mark.parametrize(
    "words",
    [
        ["ros2", "pkg", "list"],
        *(
            pytest.param(each, marks=pytest.mark.slow)
            for each in (["--help"], ["setup", "bash"], ["ros2", "interface", "show", "std_msgs/msg/String"])
        ),
    ],
    ids=" ".join,
)
def test_full_disk_is_reported_once(words: list[str], tmp_path: Path) -> None:
    with open("/dev/full", "w") as full:
        done = command(words, tmp_path, stdout=full)
    assert done.returncode == 1
    assert done.stderr.strip().splitlines()[-1].endswith("the output cannot be written: No space left on device")
    assert len(done.stderr.strip().splitlines()) == 1, done.stderr


def test_closed_pipe_is_not_an_error(tmp_path: Path) -> None:
    reader, writer = os.pipe()
    os.close(reader)
    with open(writer, "w") as closed:
        done = command(["ros2", "interface", "list"], tmp_path, stdout=closed)
    assert (done.returncode, done.stderr) == (1, "")


@pytest.mark.skipif(os.name == "nt", reason="needs a POSIX shell to close the streams")
@pytest.mark.parametrize(
    "closed", ["<&- >&- 2>&-", *(pytest.param(each, marks=pytest.mark.slow) for each in (">&-", "2>&-"))]
)
def test_closed_standard_streams_are_not_an_error(closed: str, tmp_path: Path) -> None:
    program = [sys.executable, "-c", "from bot_console.tui.cli.main import program; program()", "node", "list"]
    line = ["sh", "-c", f'exec "$0" "$@" {closed}', *program]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    done = subprocess.run(
        line, cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=TIMEOUT_S, check=False
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


@pytest.mark.skipif(os.name == "nt", reason="needs a POSIX shell to close the streams")
def test_launched_nodes_have_streams_if_those_of_the_launch_were_closed(tmp_path: Path) -> None:
    (tmp_path / "node.py").write_text("import os\nos.fstat(0)\nprint('x')")
    text = "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    text += "def generate_launch_description():\n    return LaunchDescription([Node(executable='./node.py')])\n"
    (tmp_path / "a.launch.py").write_text(text)
    program = "from bot_console.tui.cli.main import program; program()"
    words = [sys.executable, "-c", program, "launch", "./a.launch.py"]
    line = ["sh", "-c", 'exec "$0" "$@" <&- >&-', *words]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path), "ROS_LOG_DIR": str(tmp_path / "log")}
    done = subprocess.run(
        line, cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=TIMEOUT_S, check=False
    )
    logs = "".join(each.read_text() for each in (tmp_path / "log").rglob("*.log"))
    assert done.returncode == 0 and "process has finished cleanly" in logs, (done.stderr, logs)


@pytest.mark.slow
def test_character_missing_in_terminal_encoding_is_not_an_error(tmp_path: Path) -> None:
    done = command(["doctor"], tmp_path, env={"PYTHONIOENCODING": "ascii"}, stdout=subprocess.PIPE)
    assert "? domain" in done.stdout and done.stderr == ""


@pytest.mark.parametrize(
    "words",
    [
        ["run", "x.py"],
        *(pytest.param(each, marks=pytest.mark.slow) for each in (["ros2", "pkg", "list"], ["launch", "x.launch.py"])),
        *(pytest.param(each, marks=pytest.mark.slow) for each in (["launch", "PATH"], ["up"], ["setup", "editor"])),
    ],
    ids=" ".join,
)
def test_deleted_folder_is_reported(words: list[str], tmp_path: Path) -> None:
    there = tmp_path / "gone"
    there.mkdir()
    (tmp_path / "there.launch.py").touch()
    words = [str(tmp_path / "there.launch.py") if each == "PATH" else each for each in words]
    program = "import os, sys; os.rmdir(os.getcwd()); from bot_console.tui.cli.main import program; program()"
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(each for each in sys.path if each)}
    done = subprocess.run(
        [sys.executable, "-c", program, *words], cwd=there, env=environment, capture_output=True, text=True,
        timeout=TIMEOUT_S, check=False,
    )  # fmt: skip
    assert done.returncode == 1 and "Traceback" not in done.stderr
    assert done.stderr.strip().endswith("the folder you are in was deleted; go to another one (cd) and try again")


def test_failing_import_in_a_deleted_folder_is_reported_as_such(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def fails() -> int:
        raise SystemError("error return without exception set")  # The message of Python 3.13.0.

    with pytest.raises(SystemError):
        run_and_report(fails)
    there = tmp_path / "gone"
    there.mkdir()
    monkeypatch.chdir(there)
    there.rmdir()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("sys.stdout", io.StringIO())
        assert run_and_report(fails) == 1
    assert capsys.readouterr().err.endswith("the folder you are in was deleted; go to another one (cd) and try again\n")


def test_launch_runs_without_log_files_if_home_is_unwritable(tmp_path: Path) -> None:
    (tmp_path / "say.launch.py").write_text(
        "from launch import LaunchDescription\nfrom launch.actions import LogInfo\n"
        "def generate_launch_description():\n    return LaunchDescription([LogInfo(msg='here we are')])\n"
    )
    home = tmp_path / "file"
    home.write_text("no folder")
    extra = {"HOME": str(home), "ROS_LOG_DIR": "", "ROS_HOME": "", "TMPDIR": str(tmp_path)}
    done = command(["launch", "say.launch.py"], tmp_path, env=extra, stdout=subprocess.PIPE)
    message = done.stdout + done.stderr
    assert done.returncode == 0 and "here we are" in message and "Traceback" not in message
    assert f"log files are not kept: {home}/.ros/log cannot be written" in done.stderr


def test_files_in_working_folder_do_not_shadow_libraries_of_launch_host(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("queue", "tty", "yaml", "socket", "random", "launch", "bot_console"):
        (tmp_path / f"{name}.py").write_text("raise SystemExit('not meant for you')\n")
    node = tmp_path / "nodes" / "waits.py"
    node.parent.mkdir()
    node.write_text(WAITS)
    monkeypatch.chdir(tmp_path)
    host = start_host(log=tmp_path / "host.log")
    launcher = HostedLauncher(host.connection, lambda *record: None, lambda *printed: None)
    answer = launcher.launch(str(PROGRAM_LAUNCH), {"program": str(node)}).result(TIMEOUT_S)
    states = [each.state for each in launcher.info().processes]
    launcher.close()
    host.end()
    assert answer.ok and states == [ProcessState.RUNNING], (answer.text, (tmp_path / "host.log").read_text())


@pytest.mark.skipif(sys.platform != "linux", reason="needs file names with arbitrary bytes")
def test_node_below_a_path_that_is_not_utf_8_logs_as_usual(tmp_path: Path) -> None:
    folder = tmp_path / os.fsdecode(b"\xff")
    folder.mkdir()
    node = folder / os.fsdecode(b"n\xe9.py")
    node.write_text(
        "import rclpy\nrclpy.init()\nnode = rclpy.create_node('a')\n"
        "node.get_logger().info(f'in {__file__}')\nnode.get_logger().info('done')\n"
    )
    done = command(["run", str(node)], tmp_path, stdout=subprocess.PIPE)
    lines = done.stderr.splitlines()
    assert done.returncode == 0 and len(lines) == 2 and lines[1].endswith("[a]: done"), done.stderr


def test_character_missing_in_the_c_locale_is_replaced(tmp_path: Path) -> None:
    program = (
        "from bot_console.runtime.programs.exit_messages import run_and_report; "
        "run_and_report(lambda: print(chr(0xfffd), 'held') or 0)"
    )
    locale = {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path), **locale}
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=tmp_path, env=environment, capture_output=True, check=False
    )
    assert (done.returncode, done.stdout) == (0, b"? held\n"), done.stderr


@pytest.mark.skipif(os.name == "nt", reason="needs POSIX limits")
@pytest.mark.parametrize(
    ("limit", "words", "message"),
    [
        pytest.param(
            "-v 30000",
            ["topic", "list"],
            "there is too little memory (a limit is shown by `ulimit -v`)",
            marks=pytest.mark.slow,
        ),
        ("-v 100000", ["stop"], "bot-console stop: no robot was stopped: there is too little memory"),
        ("-n 8", ["stop"], "bot-console stop: no robot was stopped: too many files are open"),
        pytest.param(
            "-n 10", ["node", "list"], "too many files are open (the limit is shown by", marks=pytest.mark.slow
        ),
        pytest.param(
            "-v 400000",
            ["--headless"],
            "bot-console needs an address space of 500,000 KiB",
            marks=pytest.mark.slow,
        ),
        pytest.param("-f 0", ["up"], "bot-console needs files of 64 KiB", marks=pytest.mark.slow),
        ("-f 0", ["export", "there"], "not exported: "),
    ],
)
def test_shell_limit_is_reported_in_one_line(limit: str, words: list[str], message: str, tmp_path: Path) -> None:
    program = [sys.executable, "-c", "import sys; sys.argv[0] = 'bot-console'\n"
               "from bot_console.tui.cli.main import program; program()", *words]  # fmt: skip
    line = ["sh", "-c", f'ulimit {limit}; exec "$0" "$@"', *program]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path), "BOT_CONSOLE_USER_DIR": str(tmp_path)}
    done = subprocess.run(
        line, cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=TIMEOUT_S, check=False
    )
    assert done.returncode == 1 and done.stdout == ""
    assert done.stderr.startswith(message) and len(done.stderr.splitlines()) == 1, done.stderr
