"""Python programs and files that a `CMakeLists.txt` installs."""

from __future__ import annotations

from pathlib import Path

import pytest
from bot_console.runtime.workspace.cmake_lists import read_cmake_lists
from bot_console.runtime.workspace.discover import Workspace
from bot_console.runtime.workspace.package import read_package

PACKAGE = '<package format="3"><name>mixed</name><version>0.1.0</version></package>'
HEAD = "cmake_minimum_required(VERSION 3.8)\nproject(mixed LANGUAGES CXX)\nfind_package(rclcpp REQUIRED)\n"


def make(folder: Path, text: str) -> Path:
    for path in ("mixed/__init__.py", "scripts/talk.py", "scripts/listen", "launch/a.launch.py", "config/deep/p.yaml"):
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).touch()
    (folder / "package.xml").write_text(PACKAGE)
    (folder / "CMakeLists.txt").write_text(HEAD + text)
    return folder


@pytest.mark.parametrize(
    "text",
    [
        "install(PROGRAMS scripts/talk.py scripts/listen DESTINATION lib/${PROJECT_NAME})",
        'install(PROGRAMS\n  scripts/talk.py # the first\n  "scripts/listen"\n  DESTINATION lib/mixed\n)',
        "set(ALL scripts/talk.py scripts/listen)\nINSTALL(PROGRAMS ${ALL} DESTINATION lib/${PROJECT_NAME})",
        "file(GLOB ALL scripts/*)\ninstall(PROGRAMS ${ALL} DESTINATION lib/${PROJECT_NAME}/)",
        "file(GLOB ALL RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR}/scripts/*)\n"
        "install(PROGRAMS ${ALL} DESTINATION lib/${PROJECT_NAME})",
        "install(DIRECTORY scripts/ DESTINATION lib/${PROJECT_NAME} USE_SOURCE_PERMISSIONS)",
    ],
)
def test_installed_programs_become_scripts(tmp_path: Path, text: str) -> None:
    folder = make(tmp_path / "mixed", text)
    assert read_cmake_lists(folder).scripts == {
        "talk.py": folder / "scripts" / "talk.py",
        "listen": folder / "scripts" / "listen",
    }


def test_rename_option_names_the_script(tmp_path: Path) -> None:
    folder = make(tmp_path / "mixed", "install(PROGRAMS scripts/talk.py DESTINATION lib/mixed RENAME talk)")
    assert read_cmake_lists(folder).scripts == {"talk": folder / "scripts" / "talk.py"}


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("ament_python_install_package(${PROJECT_NAME})", "mixed"),
        ("ament_python_install_package(mixed PACKAGE_DIR scripts)", "scripts"),
    ],
)
def test_ament_python_install_package_gives_the_module_folder(tmp_path: Path, text: str, place: str) -> None:
    folder = make(tmp_path / "mixed", text)
    assert read_cmake_lists(folder).modules == {"mixed": folder / place}


def test_package_folder_serves_as_share_when_layout_matches(tmp_path: Path) -> None:
    folder = make(tmp_path / "mixed", "install(DIRECTORY launch config DESTINATION share/${PROJECT_NAME}/)")
    assert Workspace([tmp_path]).share("mixed") == folder


def test_share_folder_with_another_layout_is_built_of_links(tmp_path: Path) -> None:
    text = (
        "install(DIRECTORY config/ DESTINATION share/${PROJECT_NAME})\n"
        "install(FILES launch/a.launch.py DESTINATION share/${PROJECT_NAME}/start)"
    )
    make(tmp_path / "mixed", text)
    found = Workspace([tmp_path])
    share = found.share("mixed")
    assert share is not None
    assert {str(path.relative_to(share)) for path in share.rglob("*") if path.is_file()} == {
        "deep/p.yaml",
        "package.xml",
        "start/a.launch.py",
    }


@pytest.mark.parametrize(
    "text",
    [
        "add_executable(fast src/fast.cpp)\ninstall(TARGETS fast DESTINATION lib/${PROJECT_NAME})",
        "install(PROGRAMS ${UNKNOWN} scripts/gone.py DESTINATION lib/${PROJECT_NAME})",
        "# install(PROGRAMS scripts/talk.py DESTINATION lib/${PROJECT_NAME})",
        "install(DIRECTORY nowhere/ DESTINATION lib/${PROJECT_NAME})",
        "if(BUILD_TESTING)\n  find_package(ament_lint_auto REQUIRED)\nendif()\nament_package()",
        "install(PROGRAMS scripts/talk.py",
    ],
)
def test_files_installed_elsewhere_are_not_scripts_or_modules(tmp_path: Path, text: str) -> None:
    found = read_cmake_lists(make(tmp_path / "mixed", text))
    assert (found.scripts, found.modules) == ({}, {})


def test_file_that_is_not_text_is_reported_by_path(tmp_path: Path) -> None:
    folder = make(tmp_path / "mixed", "")
    (folder / "CMakeLists.txt").write_bytes(b"\xff\xfe")
    assert read_package(folder).problem.startswith(str(folder / "CMakeLists.txt"))


def test_name_longer_than_any_file_may_have_is_a_problem_of_its_package(tmp_path: Path) -> None:
    package = read_package(make(tmp_path, f"install(PROGRAMS {'x' * 300} DESTINATION lib/${{PROJECT_NAME}})"))
    assert package.problem.startswith(f"{package.folder}: File name too long: ")
    assert len(package.problem) < len(str(package.folder)) + 150
