"""`ros2 pkg` and `ros2 run`: a created package can be run."""

from __future__ import annotations

import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from bot_console.runtime.workspace import discover


@pytest.fixture
def src(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """An empty workspace that is read again for each request."""
    before = discover.workspace()
    (tmp_path / "src").mkdir()
    monkeypatch.chdir(tmp_path / "src")
    use(tmp_path / "src")
    yield tmp_path / "src"
    discover.use(before)


def use(folder: Path) -> None:
    discover.use(discover.Workspace([folder]))


def test_created_package_runs(ros, src: Path) -> None:
    words = ("--build-type", "ament_python", "--node-name", "hello", "--dependencies", "rclpy", "std_msgs")
    made = ros.ask("pkg", "create", "my_first", *words)
    assert (made.exit, made.stderr) == (0, "")
    use(src)
    assert ros.ask("pkg", "executables", "my_first").stdout == "my_first hello\n"
    assert ros.ask("run", "my_first", "hello").stdout == "Hi from my_first.\n"
    assert "my_first\n" in ros.ask("pkg", "list").stdout
    assert ros.ask("pkg", "xml", "my_first", "-t", "name").stdout == "my_first\n"
    assert Path(ros.ask("pkg", "prefix", "--share", "my_first").stdout.strip(), "package.xml").is_file()


def test_create_reports_each_file(ros, src: Path) -> None:
    words = (
        "--build-type",
        "ament_python",
        "--license",
        "MIT",
        "--maintainer-name",
        "A",
        "--maintainer-email",
        "a@b.c",
    )
    made = ros.ask("pkg", "create", *words, "--description", "It's <new>", "told")
    lines = made.stdout.splitlines()
    assert lines[:2] == ["going to create a new package", "package name: told"]
    assert "maintainer: ['A <a@b.c>']" in lines
    created = [Path(line.removeprefix("creating ")) for line in lines if line.startswith("creating ./")]
    assert created
    assert all(each.is_file() for each in created)
    assert "<description>It's &lt;new&gt;</description>" in Path("told/package.xml").read_text("utf-8")
    assert compile(Path("told/setup.py").read_text("utf-8"), "setup.py", "exec")


@pytest.mark.parametrize(
    ("words", "refusal"),
    [
        (["--build-type", "ament_python", "Bad-Name"], "Aborted since the package name 'Bad-Name' is invalid"),
        (["--build-type", "ament_python", "test"], "Aborted since 'ament_python' packages can't be named 'test'"),
        (["--build-type", "ament_python", "here"], "\nAborted!\nThe directory already exists: ./here\n"),
    ],
)
def test_create_rejects_invalid_packages(ros, src: Path, words: list[str], refusal: str) -> None:
    Path("here").mkdir()
    made = ros.ask("pkg", "create", *words)
    assert (made.exit, made.stdout) == (1, "")
    assert made.stderr.startswith(refusal)


SETUP = "from setuptools import setup\nsetup(name='p', packages=['p'], entry_points={'console_scripts': [%s]})\n"


def package(src: Path, name: str, **modules: str) -> None:
    folder = src / name
    (folder / name).mkdir(parents=True)
    (folder / "package.xml").write_text(
        f"<package><name>{name}</name><export><build_type>ament_python</build_type></export></package>", "utf-8"
    )
    (folder / name / "__init__.py").touch()
    scripts = ", ".join(f"'{each} = {name}.{each}:main'" for each in modules)
    (folder / "setup.py").write_text((SETUP % scripts).replace("'p'", f"'{name}'"), "utf-8")
    for each, text in modules.items():
        (folder / name / f"{each}.py").write_text(text, "utf-8")
    use(src)


def test_run_passes_arguments_and_exit_code(ros, src: Path) -> None:
    package(src, "p", report="import sys\ndef main():\n    print(sys.argv[1:])\n    return 3\n")
    reported = ros.ask("run", "p", "report", "a", "--ros-args", "-p", "x:=1")
    assert reported.stdout == "['a', '--ros-args', '-p', 'x:=1']\n[ros2run]: Process exited with failure 3\n"
    assert reported.exit == 3


def test_package_can_import_from_another(ros, src: Path) -> None:
    package(src, "library", words="TEXT = 'from the library'\n")
    package(src, "user", show="from library.words import TEXT\ndef main():\n    print(TEXT)\n")
    assert ros.ask("run", "user", "show").stdout == "from the library\n"


@pytest.mark.parametrize("name", ["intelligent_robot", "bot_console_robot"])
def test_workspace_package_takes_precedence_over_the_bundled_one(name: str, ros, src: Path) -> None:
    assert "robot_node" in ros.ask("pkg", "executables", name).stdout
    use(src)  # as in a new process: packages are searched for once
    package(src, name, robot_node="def main():\n    print('theirs')\n")
    assert ros.ask("run", name, "robot_node").stdout == "theirs\n"
    assert ros.ask("run", name, "sensor_node").stderr == "No executable found\n"


def test_module_without_main_is_explained(ros, src: Path) -> None:
    package(src, "p", empty="TEXT = 1\n")
    failed = ros.ask("run", "p", "empty")
    assert failed.exit == 1
    assert "AttributeError: module 'p.empty' has no attribute 'main'\n" in failed.stderr
    assert "setup.py" in failed.stderr.splitlines()[-1]


def test_traceback_shows_the_users_lines_only(ros, src: Path) -> None:
    package(src, "p", broken="def main():\n    return 1 / 0\n")
    failed = ros.ask("run", "p", "broken")
    assert failed.exit == 1
    assert failed.stderr.count("  File ") == 1
    assert "broken.py" in failed.stderr


def test_ctrl_c_ends_the_node(ros, src: Path) -> None:
    spin = "import rclpy\ndef main():\n    rclpy.init()\n    rclpy.spin(rclpy.create_node('s'))\n"
    package(src, "p", spin=spin)
    stopped = ros.ask("run", "p", "spin", stop_after=1.0)
    assert stopped.stderr.splitlines()[-1] == "KeyboardInterrupt"
    assert stopped.stdout == "[ros2run]: Interrupt\n"


@pytest.mark.skipif(sys.platform == "win32", reason="needs a POSIX shell")
def test_prefix_runs_a_separate_process(ros, src: Path) -> None:
    package(src, "p", report="def main():\n    pass\n")
    assert ros.ask("run", "--prefix", "echo prefixed", "p", "report").stdout.startswith("prefixed ")


@pytest.mark.skipif(sys.platform == "win32", reason="needs a POSIX shell")
@pytest.mark.parametrize(
    ("prefix", "output"),
    [
        ("python3 -X importtime", "import time:"),
        ("python3 -m pdb -c continue", "The program exited via sys.exit()"),
        ("python3 -X utf8 -W error", "node ['word']"),
        ("python3 -m cProfile -s calls", "function calls"),
        pytest.param("python3 -m trace --count --summary --missing -C .", "lines   cov%", marks=pytest.mark.slow),
        ("env GREETING=hello", "hello node ['word']"),
        ("nice -n 1", "node ['word']"),
        (
            f"{sys.executable} -c 'import runpy, sys; runpy.run_path(sys.argv[1], run_name=\"__main__\")'",
            "node ['word']",
        ),
    ],
)
def test_prefixes_that_run_scripts_get_a_script(ros, src: Path, prefix: str, output: str) -> None:
    package(
        src, "p",
        report="import os, sys, rclpy\nfrom p import other\n"
        "def main():\n    print(os.getenv('GREETING', ''), 'node', [word for word in sys.argv if word == 'word'])\n",
        other="",
    )  # fmt: skip
    answer = ros.ask("run", "--prefix", prefix, "p", "report", "word")
    assert output in answer.stdout + answer.stderr, answer
    assert " node " in f" {answer.stdout}", answer


@pytest.mark.parametrize("program", ["rqt_plot", "rqt_reconfigure", "rqt_graph", "rqt_console"])
def test_rqt_programs_name_the_pane(ros, program: str) -> None:
    answer = ros.ask("run", program, program)
    assert answer.exit == 1
    assert answer.stderr.startswith(f"{program} is the pane ")


def test_launch_show_args_without_file_lists_launch_files(ros, src: Path) -> None:
    reported = ros.ask("launch", "bot_console_robot", "--show-args")
    assert (reported.exit, reported.stderr) == (0, "")
    assert "    robot_system.launch.py\n" in reported.stdout and "    environment_launch.py\n" in reported.stdout
    package(src, "p", report="def main():\n    pass\n")
    assert "package 'p' has no launch files" in ros.ask("launch", "p", "--show-args").stderr


def test_created_cmake_package_has_interfaces_and_nodes(ros, src: Path) -> None:
    words = (
        "--build-type",
        "ament_cmake",
        "--dependencies",
        "std_msgs",
        "--node-name",
        "hello",
        "--library-name",
        "my_lib",
    )
    made = ros.ask("pkg", "create", *words, "cmake_made_msgs")
    assert made.exit == 0
    lines = made.stdout.splitlines()
    assert "creating source and include folder" in lines
    assert "creating folder ./cmake_made_msgs/include/cmake_made_msgs" in lines
    assert "interfaces in its msg/" in made.stderr
    folder = Path("cmake_made_msgs")
    listed = (folder / "CMakeLists.txt").read_text("utf-8")
    for needed in (
        "project(cmake_made_msgs",
        "find_package(std_msgs REQUIRED)",
        "add_executable(hello src/hello.cpp)",
    ):
        assert needed in listed
    assert listed.endswith("ament_package()\n")
    assert "class CMAKE_MADE_MSGS_PUBLIC MyLib" in (folder / "include" / "cmake_made_msgs" / "my_lib.hpp").read_text(
        "utf-8"
    )
    (folder / "msg").mkdir()
    (folder / "msg" / "Num.msg").write_text("std_msgs/Header header\nint64 num\n")
    use(src)
    assert "int64 num" in ros.ask("interface", "show", "cmake_made_msgs/msg/Num").stdout
    assert ros.ask("pkg", "xml", "cmake_made_msgs", "-t", "depend").stdout == "std_msgs\n"


def test_created_plain_cmake_package_does_not_use_ament(ros, src: Path) -> None:
    assert ros.ask("pkg", "create", "--build-type", "cmake", "plain_cmake").exit == 0
    assert "ament" not in Path("plain_cmake/CMakeLists.txt").read_text("utf-8")
    assert "<build_type>cmake</build_type>" in Path("plain_cmake/package.xml").read_text("utf-8")


EVERYTHING = ("--license", "MIT", "--dependencies", "std_msgs", "--node-name", "hello", "--library-name", "my_lib")


def test_created_package_with_all_options_has_the_files_of_ros(ros, src: Path) -> None:
    """The folders and files of ROS 2, in its order; no line is printed for the license file."""
    lines = ros.ask("pkg", "create", *EVERYTHING, "made").stdout.splitlines()
    assert lines[lines.index("creating folder ./made") :] == [
        "creating folder ./made",
        "creating ./made/package.xml",
        "creating source and include folder",
        "creating folder ./made/src",
        "creating folder ./made/include/made",
        "creating ./made/CMakeLists.txt",
        "creating ./made/src/hello.cpp",
        "creating ./made/include/made/my_lib.hpp",
        "creating ./made/src/my_lib.cpp",
        "creating ./made/include/made/visibility_control.h",
    ]
    assert Path("made/LICENSE").read_text("utf-8").startswith("Permission is hereby granted, free of charge")
    listed = Path("made/CMakeLists.txt").read_text("utf-8")
    for needed in (
        "find_package(ament_cmake_ros REQUIRED)",
        "MADE_BUILDING_LIBRARY",
        "target_link_libraries(hello my_lib)",
        "ament_export_targets(\n  export_${PROJECT_NAME}\n)",
    ):
        assert needed in listed
    assert "<buildtool_depend>ament_cmake_ros</buildtool_depend>" in Path("made/package.xml").read_text("utf-8")


def test_license_question_mark_lists_licenses(ros, src: Path) -> None:
    reported = ros.ask("pkg", "create", "--license", "?", "nothing")
    assert reported.stdout.splitlines()[:3] == ["Supported licenses:", "Apache-2.0", "BSL-1.0"]
    assert (reported.exit, Path("nothing").exists()) == (0, False)


@pytest.mark.parametrize(
    ("license_name", "begin"),
    [
        ("Apache-2.0", "Apache License"),
        ("BSD-2-Clause", "Redistribution and use"),
        ("BSD-3-Clause", "Redistribution and use"),
        ("BSL-1.0", "Boost Software License - Version 1.0"),
        ("MIT-0", "Permission is hereby granted"),
    ],
)
def test_license_file_is_written(ros, src: Path, license_name: str, begin: str) -> None:
    made = ros.ask("pkg", "create", "--build-type", "ament_python", "--license", license_name, "p")
    assert "WARNING" not in made.stdout
    assert Path("p/LICENSE").read_text("utf-8").lstrip().startswith(begin)


@pytest.mark.parametrize("license_name", ["GPL-3.0-only", "my own", "../MIT"])
def test_license_without_text_is_warned_about(ros, src: Path, license_name: str) -> None:
    made = ros.ask("pkg", "create", "--build-type", "ament_python", "--license", license_name, "p")
    assert f"'{license_name}'" in made.stdout.partition("[WARNING]: ")[2]
    assert not Path("p/LICENSE").exists()


@pytest.mark.parametrize("build_type", ["ament_python", "ament_cmake"])
def test_node_named_like_its_library_is_renamed(ros, src: Path, build_type: str) -> None:
    made = ros.ask("pkg", "create", "--build-type", build_type, "--node-name", "x", "--library-name", "x", "p")
    assert "[WARNING] renaming node to x_node\n" in made.stderr
    assert "node_name: x_node\n" in made.stdout
    assert Path("p", *(["p", "x_node.py"] if build_type == "ament_python" else ["src", "x_node.cpp"])).exists()


@pytest.mark.soak
@pytest.mark.skipif(
    not all(map(shutil.which, ("cmake", "c++"))) or sys.platform == "win32", reason="needs cmake and a C++ compiler"
)
def test_created_plain_cmake_package_builds_and_is_found(ros, src: Path) -> None:
    ros.ask("pkg", "create", "--build-type", "cmake", "--node-name", "hello", "--library-name", "lib", "first")
    ros.ask("pkg", "create", "--build-type", "cmake", "--node-name", "hello", "second", "--dependencies", "first")
    prefix = src / "installed"
    for package in ("first", "second"):
        prefixes = (f"-DCMAKE_INSTALL_PREFIX={prefix}", f"-DCMAKE_PREFIX_PATH={prefix}")
        for words in (("-S", package, "-B", f"build/{package}", *prefixes), ("--build", f"build/{package}"),
                      ("--install", f"build/{package}")):  # fmt: skip
            done = subprocess.run(["cmake", *words], capture_output=True, text=True, check=False)
            assert done.returncode == 0, done.stderr
    message = subprocess.run([prefix / "lib" / "second" / "hello"], capture_output=True, text=True, check=True)
    assert message.stdout == "hello world second package\n"
