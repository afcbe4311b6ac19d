"""Commands of `ros2` that bot-console answers differently."""

from __future__ import annotations

import subprocess
import sys

import pytest
from bot_console.tui.cli.completion import candidates
from bot_console.tui.cli.main import main


@pytest.mark.parametrize("verb", ["status", "stop"])
def test_daemon_stop_reports_that_there_is_none(capsys: pytest.CaptureFixture[str], verb: str) -> None:
    assert main(["ros2", "daemon", verb]) == 0
    assert capsys.readouterr().out == "The daemon is not running\n"


def test_daemon_start_reports_that_there_is_none(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["ros2", "daemon", "start"]) == 0
    assert "no daemon is started" in capsys.readouterr().err


@pytest.mark.parametrize("words", [("doctor",), ("wtf",), ("doctor", "--report"), ("doctor", "-iw")])
def test_doctor_checks_this_machine(capsys: pytest.CaptureFixture[str], words: tuple[str, ...]) -> None:
    main(["ros2", *words])
    assert "python" in capsys.readouterr().out


def test_prefix_runs_before_the_executable() -> None:
    """The program named by `--prefix` gets the executable and its arguments, in a separate process."""
    words = ["--prefix", "echo 'with this'", "demo_nodes_py", "talker", "--ros-args", "-r", "__node:=t"]
    code = "import sys; from bot_console.tui.cli.main import main; sys.exit(main(sys.argv[1:]))"
    ended = subprocess.run(
        [sys.executable, "-c", code, "ros2", "run", *words], capture_output=True, text=True, check=False
    )
    assert ended.returncode == 0, ended.stderr
    assert ended.stdout.startswith("with this ")
    assert ended.stdout.endswith("/demo_nodes_py/talker --ros-args -r __node:=t\n")


def test_prefix_is_refused_for_a_program_of_the_console(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["run", "--watch", "--prefix=echo", "demo_nodes_py", "talker"])
    assert "leave out --watch and --headless" in capsys.readouterr().err


def test_upstream_commands_are_completed() -> None:
    assert {"bag", "daemon", "doctor"} <= set(candidates(["ros2", ""]))
    assert candidates(["ros2", "daemon", "st"]) == ["start", "status", "stop"]
