"""`bot-console setup venv`: a virtual environment whose programs import rclpy in any shell."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest
from bot_console.tui.cli.main import main
from helpers.shells import PYTHON, python
from sampling import slow_after


@pytest.fixture
def venv(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("BOT_CONSOLE_USER_DIR", str(tmp_path / "user"))
    monkeypatch.delenv("VIRTUAL_ENV", raising=False)
    monkeypatch.delenv("PYTHONPATH", raising=False)
    subprocess.run([str(PYTHON), "-m", "venv", "--without-pip", str(tmp_path / "venv")], check=True)
    return tmp_path / "venv"


def run_in_venv(venv: Path, text: str, *options: str) -> subprocess.CompletedProcess[str]:
    return python([*options, "-c", text], os.environ, venv / "bin" / "python3", venv)


def packages(venv: Path) -> Path:
    return next((venv / "lib").iterdir()) / "site-packages"


def test_programs_of_environment_import_rclpy_until_it_is_removed(venv: Path, capsys: pytest.CaptureFixture[str]):
    assert main(["setup", "venv", str(venv)]) == 0
    text = "import rclpy; rclpy.init(); rclpy.create_node('n'); print(rclpy.__file__)"
    for option in ([], ["-I"]):
        done = run_in_venv(venv, text, *option)
        assert done.stdout.endswith("runtime/rclpy/__init__.py\n"), done.stderr
    assert main(["setup", "venv", str(venv), "--remove"]) == 0
    assert "No module named 'rclpy'" in run_in_venv(venv, text).stderr
    assert main(["setup", "venv", str(venv), "--remove"]) == 0
    assert "nothing to remove" in capsys.readouterr().out


@pytest.mark.parametrize("name", slow_after(1, ["a\nb", "\udcff", " 'ä\\\"{0} "]))
def test_name_of_the_user_folder_may_contain_anything(
    name: str, venv: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setenv("BOT_CONSOLE_USER_DIR", str(tmp_path / name))
    assert main(["setup", "venv", str(venv)]) == 0
    assert run_in_venv(venv, "import rclpy; print(rclpy.__file__)").stdout.endswith("runtime/rclpy/__init__.py\n")


def test_active_environment_is_the_default(venv: Path, monkeypatch: pytest.MonkeyPatch):
    with pytest.raises(SystemExit):
        main(["setup", "venv"])
    monkeypatch.setenv("VIRTUAL_ENV", str(venv))
    assert main(["setup", "venv"]) == 0
    assert (packages(venv) / "bot_console.pth").exists()


def test_real_rclpy_is_never_shadowed(venv: Path, capsys: pytest.CaptureFixture[str]):
    (packages(venv) / "rclpy").mkdir()
    (packages(venv) / "rclpy" / "__init__.py").touch()
    assert main(["setup", "venv", str(venv)]) == 1
    assert f"has a real rclpy ({packages(venv)}/rclpy)" in capsys.readouterr().err
    assert not (packages(venv) / "bot_console.pth").exists()
    (packages(venv) / "rclpy").rename(packages(venv) / "away")
    assert main(["setup", "venv", str(venv)]) == 0
    (packages(venv) / "away").rename(packages(venv) / "rclpy")  # installed later
    found = run_in_venv(venv, "import std_msgs, rclpy; print(rclpy.__file__)")
    assert "No module named 'std_msgs'" in found.stderr
    assert run_in_venv(venv, "import rclpy; print(rclpy.__file__)").stdout == f"{packages(venv)}/rclpy/__init__.py\n"


def test_folder_that_is_not_an_environment_and_another_python_are_refused(
    venv: Path, capsys: pytest.CaptureFixture[str]
):
    assert main(["setup", "venv", str(venv.parent)]) == 1
    assert "is not a virtual environment" in capsys.readouterr().err
    program = venv / "bin" / "python3"
    program.unlink()
    program.write_text(f'#!/bin/sh\necho \'{{"folder": "{packages(venv)}", "version": [3, 99], "real": ""}}\'\n')
    program.chmod(0o755)
    assert main(["setup", "venv", str(venv)]) == 1
    assert "has Python 3.99, and this bot-console runs on " in capsys.readouterr().err
    program.unlink()
    assert main(["setup", "venv", str(venv)]) == 1
    assert capsys.readouterr().err.endswith("does not run\n")


def test_environment_is_silent_and_unchanged_once_the_installation_is_gone(venv: Path, tmp_path: Path):
    assert main(["setup", "venv", str(venv)]) == 0
    (shims,) = (tmp_path / "user" / "cache" / "shims").iterdir()
    for each in shims.glob("*.py"):
        if each.is_symlink():
            each.unlink()
            each.symlink_to("/nowhere/shim.py")
    done = run_in_venv(venv, "print(1)\nimport rclpy")
    assert done.stdout == "1\n" and done.stderr.count("\n") in (3, 4)  # Python 3.13 shows the line
    shims.rename(shims.with_name("away"))
    assert (run_in_venv(venv, "print(1)").stdout, run_in_venv(venv, "print(1)").stderr) == ("1\n", "")


def test_start_of_python_imports_two_small_files_more(venv: Path):
    loaded = "import sys; print(*sorted(sys.modules))"
    before = {*run_in_venv(venv, loaded).stdout.split()}
    assert main(["setup", "venv", str(venv)]) == 0
    more = {*run_in_venv(venv, loaded).stdout.split()} - before
    more.discard("encodings.utf_8_sig")  # by Python 3.13, for any .pth file
    assert more <= {"bot_console_shims", "sitecustomize"}
