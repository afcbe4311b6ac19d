"""Packages that work here but would not on ROS 2: each obstacle is named with its fix, and the package still runs."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from bot_console.runtime.workspace.package import read_package
from bot_console.tui.cli.lint.packaging import defects, obstacles, shadowing_files
from bot_console.tui.cli.lint.run import run

SETUP = """\
from glob import glob
from setuptools import find_packages, setup
package_name = 'p'
setup(
    name=package_name,
    packages=[package_name],
    data_files=[
        ('share/' + package_name, ['package.xml']),
        ('share/p/launch', glob('launch/*.launch.py')),
    ],
    entry_points={'console_scripts': ['talk = p.talk:main']},
)
"""
CFG = "[develop]\nscript_dir=$base/lib/p\n[install]\ninstall_scripts=$base/lib/p\n"
XML = "<package format='3'><name>p</name><export><build_type>{}</build_type></export></package>"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A package without any fault."""
    for name, text in {
        "package.xml": XML.format("ament_python"), "setup.py": SETUP, "setup.cfg": CFG, "p/__init__.py": "",
        "p/talk.py": "import rclpy\nfrom std_msgs.msg import String\ndef main():\n    pass\n",
        "launch/all.launch.py": "", "test/test_it.py": "",
    }.items():  # fmt: skip
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text)
    return tmp_path


def obstacles_in(folder: Path) -> list[str]:
    return [str(each).replace(f"{folder}/", "") for each in obstacles(read_package(folder))]


def edit(folder: Path, old: str, new: str, file: str = "setup.py") -> None:
    text = (folder / file).read_text()
    assert old in text
    (folder / file).write_text(text.replace(old, new))


def test_a_correct_package_has_no_obstacle(folder: Path) -> None:
    assert obstacles_in(folder) == []
    edit(folder, "packages=[package_name]", "packages=find_packages(exclude=['test'])")
    edit(folder, "script_dir", "script-dir", "setup.cfg")
    assert obstacles_in(folder) == []


def test_a_missing_setup_cfg_is_named(folder: Path) -> None:
    (folder / "setup.cfg").unlink()
    (only,) = obstacles_in(folder)
    assert only.startswith("setup.cfg: is missing") and "script_dir=$base/lib/p" in only
    edit(folder, "'talk = p.talk:main'", "")
    assert obstacles_in(folder) == [], "there is nothing to be found by ros2 run"


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("script_dir=$base/lib/p", "script_dir=$base/lib/other", "setup.cfg:2: script_dir is $base/lib/other"),
        ("install_scripts=$base/lib/p", "install_scripts=$base/bin", "setup.cfg:4: install_scripts is $base/bin"),
        ("[develop]\nscript_dir=$base/lib/p\n", "", "setup.cfg: [develop] has no script_dir"),
        ("[install]\ninstall_scripts=$base/lib/p\n", "", "setup.cfg: [install] has no install_scripts"),
        ("install_scripts=$base/lib/p\n", "", "setup.cfg:3: [install] has no install_scripts"),
    ],
)
def test_a_foreign_folder_for_scripts_is_named(folder: Path, old: str, new: str, message: str) -> None:
    edit(folder, old, new, "setup.cfg")
    (only,) = obstacles_in(folder)
    assert only.startswith(message) and only.endswith("=$base/lib/p")


@pytest.mark.parametrize(
    ("file", "message"),
    [
        ("p/util/__init__.py", "packages= does not list p.util"),
        ("p/util/helper.py", "give p/util an __init__.py and add 'p.util' to packages="),
        ("p/util/deep/__init__.py", "packages= does not list p.util.deep"),
    ],
)
def test_a_package_inside_that_is_not_listed_is_named(folder: Path, file: str, message: str) -> None:
    (folder / file).parent.mkdir(parents=True)
    (folder / file).write_text("")
    (only,) = obstacles_in(folder)
    assert only.startswith("setup.py:6: ") and message in only
    edit(folder, "packages=[package_name]", "packages=['p', 'p.util', 'p.util.deep']")
    assert obstacles_in(folder) == []


def test_a_package_of_an_executable_that_is_not_listed_is_named(folder: Path) -> None:
    edit(folder, "packages=[package_name]", "packages=['q']")
    (only,) = obstacles_in(folder)
    assert "packages= does not list p, where talk is" in only


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("launch/*.launch.py", "launch/*.launch", "matches no file, so that share/p/launch stays empty"),
        ("launch/*.launch.py", "launch/*.xml", "correct the pattern: launch/ contains all.launch.py"),
        ("glob('launch/*.launch.py')", "['launch/one.launch.py']", "names launch/one.launch.py, which does not exist"),
        ("launch/*.launch.py", "lanch/*.py", "matches no file"),
        ("['package.xml']", "['package.xml', 'LICENSE']", "names LICENSE, which does not exist"),
    ],
)  # fmt: skip
def test_data_files_that_install_nothing_are_named(folder: Path, old: str, new: str, message: str) -> None:
    edit(folder, old, new)
    (only,) = obstacles_in(folder)
    assert only.startswith(("setup.py:8: ", "setup.py:9: ")) and message in only


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("        ('share/p/launch', glob('launch/*.launch.py')),\n", "", "launch/all.launch.py is not installed"),
        ("launch/*.launch.py", "launch/a*.py", "launch/other.launch.xml is not installed: data_files has no line for"),
        ("    data_files=[", "    x=[", "add ('share/p/launch', glob('launch/*launch.py'))"),
        ("['package.xml']", "['package.xml']", "config/indoor.yaml is not installed"),
    ],
)
def test_file_that_data_files_forget_is_named(folder: Path, old: str, new: str, message: str) -> None:
    (folder / "launch/other.launch.xml").touch()
    (folder / "config").mkdir()
    (folder / "config/indoor.yaml").touch()
    edit(folder, old, new)
    assert any(message in each for each in obstacles_in(folder))


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("    data_files=[", "    data_files=others() + ["),
        ("('share/p/launch', glob('launch/*.launch.py')),", "*others(),"),
        ("('share/p/launch', glob('launch/*.launch.py')),", "('share/p/launch', others()),"),
        ("    data_files=[\n", "    **others(), x=[\n"),
    ],
)
def test_no_file_is_called_forgotten_when_data_files_cannot_be_evaluated(folder: Path, old: str, new: str) -> None:
    edit(folder, old, new)
    assert obstacles_in(folder) == []


def test_another_name_in_setup_is_named(folder: Path) -> None:
    edit(folder, "name=package_name", "name='q'")
    (only,) = obstacles_in(folder)
    assert only.startswith("setup.py:5: setup() is called with the name 'q'") and only.endswith("write name='p'")


def test_entry_point_without_a_function_is_named(folder: Path) -> None:
    edit(folder, "p.talk:main", "p.talk")
    (only,) = obstacles_in(folder)
    assert only == "setup.py:11: 'talk = p.talk' names no function; write 'talk = module:function'"


@pytest.mark.parametrize(
    ("file", "old", "new", "message"),
    [
        ("package.xml", "</package>", "</packag", "package.xml: unclosed token"),
        ("setup.py", "'talk = p.talk:main'", "'talk = p.talk:main' 'b = p.b:main'", "setup.py: 'talk = p.talk:mainb"),
        ("setup.py", "name = 'p'", "name = 'p", "setup.py:3: unterminated string literal"),
        ("setup.cfg", "[install]", "[install", "setup.cfg: Source contains parsing errors"),
        ("setup.py", "p.talk:main", "p.tlak:main", "setup.py:11: talk is p.tlak:main, and there is no such module"),
    ],
)
def test_package_that_works_nowhere_is_named(
    folder: Path, file: str, old: str, new: str, message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert defects(read_package(folder)) == []
    edit(folder, old, new, file)
    (only,) = defects(read_package(folder))
    assert str(only).replace(f"{folder}/", "").startswith(message)
    assert run([str(folder)]) == 1
    (line,) = capsys.readouterr().out.splitlines()
    assert line.startswith(f"{folder}/{file}")


@pytest.mark.skipif(os.name != "posix", reason="needs POSIX permissions")
def test_programs_that_cannot_be_started_are_named(folder: Path) -> None:
    edit(folder, "    entry_points", "    scripts=['bin/run.py'],\n    entry_points")
    (folder / "bin").mkdir()
    (folder / "bin" / "run.py").write_text("print(1)\n")
    lines = obstacles_in(folder)
    assert len(lines) == 2 and "bin/run.py: the program is not executable; chmod +x" in lines[0]
    assert lines[1].startswith("bin/run.py:1: the program does not begin with a line")
    (folder / "bin" / "run.py").write_text("#!/usr/bin/env python3\n")
    (folder / "bin" / "run.py").chmod(0o755)
    assert obstacles_in(folder) == []


def test_programs_of_cmake_are_checked_too(folder: Path) -> None:
    (folder / "package.xml").write_text(XML.format("ament_cmake"))
    (folder / "setup.py").unlink()
    (folder / "CMakeLists.txt").write_text("project(p)\ninstall(PROGRAMS p/talk.py DESTINATION lib/${PROJECT_NAME})\n")
    lines = obstacles_in(folder)
    assert len(lines) == 2 and all(each.startswith("p/talk.py") for each in lines)


@pytest.mark.parametrize("name", ["std_msgs.py", "std_msgs/__init__.py", "rclpy.py"])
def test_files_that_shadow_imported_packages_are_named(folder: Path, name: str) -> None:
    (folder / "p" / name).parent.mkdir(exist_ok=True)
    (folder / "p" / name).write_text("")
    edit(folder, "packages=[package_name]", "packages=['p', 'p.std_msgs']")
    (only,) = obstacles_in(folder)
    what = name.partition("/")[0]
    assert only.startswith("p/talk.py:") and f"{what} beside it is imported" in only and f"rename {what}" in only


def test_shadowing_file_that_nobody_imports_is_not_reported(tmp_path: Path) -> None:
    (tmp_path / "queue.py").write_text("")
    (tmp_path / "node.py").write_text("import rclpy\nfrom . import queue\n")
    assert list(shadowing_files(tmp_path / "node.py")) == []
    (tmp_path / "node.py").write_text("import rclpy\nimport queue\n")
    assert [each.line for each in shadowing_files(tmp_path / "node.py")] == [2]
