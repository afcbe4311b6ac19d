"""What is installed: one package, with everything that a run needs."""

import ast
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

if sys.version_info >= (3, 11):
    import tomllib
else:
    tomllib = pytest.importorskip("tomli")

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    """The names in a wheel built from a copy of this tree, since a build writes modules that other tests import."""
    folder = tmp_path_factory.mktemp("wheel")
    copy = folder / "tree"
    shutil.copytree(ROOT, copy, ignore=shutil.ignore_patterns(".git", ".venv", "build", "generated", "__pycache__"))
    words = [sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", str(folder), str(copy)]
    subprocess.run(words, check=True, capture_output=True)
    with zipfile.ZipFile(next(folder.glob("*.whl"))) as archive:
        return archive.namelist()


SHARED = {
    "man/man1/bot-console.1",
    "bash-completion/completions/bot-console",
    "zsh/site-functions/_bot-console",
    "fish/vendor_completions.d/bot-console.fish",
}


@pytest.mark.slow
def test_wheel_contains_one_package(wheel):
    names = [name.split("/")[0] for name in wheel]
    assert {name for name in names if not name.endswith((".dist-info", ".data"))} == {"bot_console"}


@pytest.mark.slow
def test_wheel_installs_manual_page_and_shell_completion(wheel):
    assert {name.partition(".data/data/share/")[2] for name in wheel if ".data/" in name} == SHARED


@pytest.mark.slow
@pytest.mark.parametrize(
    "name",
    [
        "bot_console/tui/app.tcss",
        "bot_console/launch/robot_system.launch.py",
        "bot_console/profiles/indoor.yaml",
        "bot_console/profiles/worlds/indoor.yaml",
        "bot_console/nodes/simulator_node.py",
    ],
)
def test_wheel_contains_what_a_run_needs(wheel, name):
    assert name in wheel


@pytest.mark.slow
def test_wheel_contains_generated_messages(wheel):
    assert any(name.startswith("bot_console/runtime/rosidl/generated/") and "geometry_msgs" in name for name in wheel)


@pytest.mark.slow
def test_no_module_shadows_an_outside_name(wheel):
    assert not any(name.startswith(("rclpy/", "launch/", "tests/")) for name in wheel)


def test_wheel_is_declared_to_contain_one_package():
    """The slow tests check the same on the wheel itself."""
    wheel = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["tool"]["hatch"]["build"]["targets"]["wheel"]
    assert wheel["sources"] == {each: f"bot_console/{each}" for each in wheel["only-include"]}
    assert set(wheel["only-include"]) == {"tui", "runtime", "nodes", "profiles", "launch"}
    assert {each.removeprefix("share/") for each in wheel["shared-data"].values()} == SHARED
    assert wheel["artifacts"] == ["runtime/rosidl/generated/**"]


@pytest.mark.parametrize("folder", ["tests", "docs", "tools", "examples", ".ci", ".github"])
def test_sdist_contains_what_its_own_tests_read(folder):
    """The test suite is part of the sdist, and has to pass there."""
    assert (
        f'"{folder}"' in (ROOT / "pyproject.toml").read_text("utf-8").partition("targets.sdist]")[2].partition("]")[0]
    )


def test_generator_of_messages_runs_where_nothing_is_installed_yet():
    program = ast.parse((ROOT / "runtime" / "rosidl" / "generate.py").read_text("utf-8"))
    imported = [each.module or "" for each in program.body if isinstance(each, ast.ImportFrom)]
    assert imported
    assert [each for each in imported if each.startswith("bot_console")] == []
