"""`ros2 pkg` and `ros2 run`: a package that is created can be run."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from bot_console.runtime.workspace import discover


@pytest.fixture
def src(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """An empty workspace, read anew whenever it is asked for."""
    before = discover.workspace()
    (tmp_path / "src").mkdir()
    monkeypatch.chdir(tmp_path / "src")
    use(tmp_path / "src")
    yield tmp_path / "src"
    discover.use(before)


def use(folder: Path) -> None:
    discover.use(discover.Workspace([folder]))


def test_a_created_package_runs(ros, src: Path) -> None:
    words = ("--build-type", "ament_python", "--node-name", "hello", "--dependencies", "rclpy", "std_msgs")
    made = ros.ask("pkg", "create", "my_first", *words)
    assert (made.exit, made.stderr) == (0, "")
    use(src)
    assert ros.ask("pkg", "executables", "my_first").stdout == "my_first hello\n"
    assert ros.ask("run", "my_first", "hello").stdout == "Hi from my_first.\n"
    assert "my_first\n" in ros.ask("pkg", "list").stdout
    assert ros.ask("pkg", "xml", "my_first", "-t", "name").stdout == "my_first\n"
    assert Path(ros.ask("pkg", "prefix", "--share", "my_first").stdout.strip(), "package.xml").is_file()


def test_what_is_created_is_told_line_by_line(ros, src: Path) -> None:
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
def test_a_package_that_cannot_be(ros, src: Path, words: list[str], refusal: str) -> None:
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


def test_run_gives_the_words_and_the_exit_code(ros, src: Path) -> None:
    package(src, "p", tell="import sys\ndef main():\n    print(sys.argv[1:])\n    return 3\n")
    told = ros.ask("run", "p", "tell", "a", "--ros-args", "-p", "x:=1")
    assert told.stdout == "['a', '--ros-args', '-p', 'x:=1']\n[ros2run]: Process exited with failure 3\n"
    assert told.exit == 3


def test_a_package_can_use_another_one(ros, src: Path) -> None:
    package(src, "library", words="TEXT = 'from the library'\n")
    package(src, "user", show="from library.words import TEXT\ndef main():\n    print(TEXT)\n")
    assert ros.ask("run", "user", "show").stdout == "from the library\n"


@pytest.mark.parametrize("name", ["intelligent_robot", "bot_console_robot"])
def test_a_workspace_package_wins_over_ours(name: str, ros, src: Path) -> None:
    assert "robot_node" in ros.ask("pkg", "executables", name).stdout
    use(src)  # as in a new process: packages are looked for once
    package(src, name, robot_node="def main():\n    print('theirs')\n")
    assert ros.ask("run", name, "robot_node").stdout == "theirs\n"
    assert ros.ask("run", name, "sensor_node").stderr == "No executable found\n"


def test_a_module_without_main_is_explained(ros, src: Path) -> None:
    package(src, "p", empty="TEXT = 1\n")
    failed = ros.ask("run", "p", "empty")
    assert failed.exit == 1
    assert "AttributeError: module 'p.empty' has no attribute 'main'\n" in failed.stderr
    assert "setup.py" in failed.stderr.splitlines()[-1]


def test_an_error_shows_the_users_lines_only(ros, src: Path) -> None:
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


@pytest.mark.skipif(sys.platform == "win32", reason="a script of the system's shell")
def test_a_prefix_makes_a_process_of_its_own(ros, src: Path) -> None:
    package(src, "p", tell="def main():\n    pass\n")
    assert ros.ask("run", "--prefix", "echo prefixed", "p", "tell").stdout.startswith("prefixed ")


@pytest.mark.parametrize("program", ["rqt_plot", "rqt_reconfigure", "rqt_graph", "rqt_console"])
def test_rqt_is_the_console(ros, program: str) -> None:
    answer = ros.ask("run", program, program)
    assert answer.exit == 1
    assert answer.stderr.startswith(f"{program} is the pane ")


def test_launch_show_args_without_a_file_lists_the_launch_files(ros, src: Path) -> None:
    told = ros.ask("launch", "bot_console_robot", "--show-args")
    assert (told.exit, told.stderr) == (0, "")
    assert "    robot_system.launch.py\n" in told.stdout and "    environment_launch.py\n" in told.stdout
    package(src, "p", tell="def main():\n    pass\n")
    assert "package 'p' has no launch files" in ros.ask("launch", "p", "--show-args").stderr


def test_a_package_of_interfaces_for_cmake(ros, src: Path) -> None:
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
        "project(cmake_made_msgs)",
        "find_package(std_msgs REQUIRED)",
        "add_executable(hello src/hello.cpp)",
    ):
        assert needed in listed
    assert listed.endswith("ament_package()\n")
    assert "class MyLib" in (folder / "include" / "cmake_made_msgs" / "my_lib.hpp").read_text("utf-8")
    (folder / "msg").mkdir()
    (folder / "msg" / "Num.msg").write_text("std_msgs/Header header\nint64 num\n")
    use(src)
    assert "int64 num" in ros.ask("interface", "show", "cmake_made_msgs/msg/Num").stdout
    assert ros.ask("pkg", "xml", "cmake_made_msgs", "-t", "depend").stdout == "std_msgs\n"


def test_a_plain_cmake_package(ros, src: Path) -> None:
    assert ros.ask("pkg", "create", "--build-type", "cmake", "plain_cmake").exit == 0
    assert "ament" not in Path("plain_cmake/CMakeLists.txt").read_text("utf-8")
    assert "<build_type>cmake</build_type>" in Path("plain_cmake/package.xml").read_text("utf-8")
