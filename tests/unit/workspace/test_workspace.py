"""Source packages are found and read without running anything."""

from pathlib import Path

import pytest
from bot_console.runtime.workspace.builtin_package import FIRST_VARIABLE, NAME, PAGE_NAME, is_own
from bot_console.runtime.workspace.demos import demo_packages
from bot_console.runtime.workspace.discover import Workspace, default_folders
from bot_console.runtime.workspace.package import EntryPoint, read_package

PACKAGE = """<package format="3"><name>{name}</name><version>0.1.0</version>
<export><build_type>ament_python</build_type></export></package>"""
SETUP = """
import os
from glob import glob
from setuptools import find_packages, setup
package_name = "demo"
files = [(os.path.join("share", package_name, "config"), glob("config/*.yaml"))]
raise SystemExit("never run")
setup(
    name=package_name,
    packages=find_packages(exclude=["test"]),
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/" + package_name]),
        ("share/" + package_name, ["package.xml"]),
        (os.path.join("share", package_name, "launch"), glob("launch/*.py")),
        (f"share/{package_name}/odd", glob("config/*.yaml")),
        (os.getcwd(), ["x"]),
    ],
    entry_points={"console_scripts": ["talker = demo.talker:main", "bare = demo.bare"]},
)
"""


def make(folder: Path, name: str = "demo", setup: str = SETUP) -> Path:
    for sub in ("launch", "config", "demo"):
        (folder / sub).mkdir(parents=True)
    (folder / "package.xml").write_text(PACKAGE.format(name=name))
    (folder / "setup.py").write_text(setup)
    (folder / "demo" / "__init__.py").touch()
    (folder / "launch" / "a.launch.py").touch()
    (folder / "config" / "p.yaml").touch()
    return folder


def test_setup_py_is_read_without_running_it(tmp_path: Path) -> None:
    package = read_package(make(tmp_path / "demo"))
    assert package.executables == {"talker": EntryPoint("demo.talker", "main"), "bare": EntryPoint("demo.bare", "main")}
    assert package.modules == {"demo": tmp_path / "demo" / "demo"}
    assert ("share/demo/launch", (tmp_path / "demo" / "launch" / "a.launch.py",)) in package.data_files
    assert package.problem == ""


def test_share_folder_with_another_layout_is_built_of_links(tmp_path: Path) -> None:
    make(tmp_path / "demo")
    found = Workspace([tmp_path])
    share = found.share("demo")
    assert share is not None
    assert (share / "odd" / "p.yaml").exists()
    assert (share / "launch" / "a.launch.py").exists()
    assert share != tmp_path / "demo"


def test_package_folder_serves_as_share_when_layout_matches(tmp_path: Path) -> None:
    make(tmp_path / "demo", setup=SETUP.replace("/odd", "/config"))
    assert Workspace([tmp_path]).share("demo") == tmp_path / "demo"


def test_entry_points_are_read_from_setup_cfg(tmp_path: Path) -> None:
    folder = make(tmp_path / "demo", setup="from setuptools import setup\nsetup()\n")
    (folder / "setup.cfg").write_text("[options.entry_points]\nconsole_scripts =\n  talker = demo.talker:main\n")
    assert read_package(folder).executables == {"talker": EntryPoint("demo.talker", "main")}


def test_broken_setup_py_and_package_xml_are_reported(tmp_path: Path) -> None:
    folder = make(tmp_path / "demo", setup="setup(\n")
    assert "setup.py:1" in read_package(folder).problem
    (folder / "package.xml").write_text("<package>")
    assert "package.xml" in read_package(folder).problem


def test_malformed_entry_point_is_reported_and_others_are_kept(tmp_path: Path) -> None:
    setup = SETUP.replace('"bare = demo.bare"', '"a = demo.a:main" "b = demo.b:main"')
    package = read_package(make(tmp_path / "demo", setup=setup))
    assert set(package.executables) == {"talker"}
    assert "setup.py: 'a = demo.a:mainb = demo.b:main' is not of the form" in package.problem


def test_entry_points_with_syntax_error_are_reported_with_line(tmp_path: Path) -> None:
    setup = SETUP.replace('"console_scripts": [', '"console_scripts" [')
    problem = read_package(make(tmp_path / "demo", setup=setup)).problem
    assert "setup.py: entry_points cannot be evaluated, line 18" in problem


def test_packages_are_found_as_colcon_finds_them(tmp_path: Path) -> None:
    make(tmp_path / "src" / "deep" / "one", "one")
    make(tmp_path / "src" / "two", "two")
    make(tmp_path / "src" / "two" / "inner", "inner")
    make(tmp_path / "build" / "three", "three")
    make(tmp_path / "src" / "four", "four")
    (tmp_path / "src" / "four" / "COLCON_IGNORE").touch()
    found = Workspace(default_folders(tmp_path)).packages
    assert set(found) - set(demo_packages()) == {"one", "two", NAME}


def test_package_xml_linking_to_itself_is_ignored(tmp_path: Path) -> None:
    make(tmp_path / "demo")
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "package.xml").symlink_to("package.xml")
    assert {*Workspace([tmp_path]).packages} - {*demo_packages()} == {"demo", NAME}


@pytest.mark.parametrize("name", [NAME, PAGE_NAME])
def test_workspace_package_with_our_name_takes_precedence(name: str, tmp_path: Path) -> None:
    folder = make(tmp_path / "robot", name)
    found = Workspace([tmp_path])
    assert found.packages[name].folder == folder
    assert found.find(name) is found.packages[name]
    assert found.share(name) != Workspace([]).share(name)


@pytest.mark.parametrize("name", [NAME, PAGE_NAME])
def test_our_name_means_our_package_in_our_own_launch(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    make(tmp_path / "robot", name)
    found = Workspace([tmp_path])
    assert not is_own(found.packages[name])
    monkeypatch.setenv(FIRST_VARIABLE, "1")
    assert is_own(found.packages[NAME])
    assert is_own(found.packages[name]) == (name == NAME)
    share = found.share(NAME)
    assert share is not None
    assert (share / "worlds" / "indoor.yaml").exists()


@pytest.mark.parametrize("name", [NAME, PAGE_NAME])
def test_own_package_has_a_share_folder(name: str) -> None:
    own = Workspace([])
    share = own.share(name)
    assert share is not None
    profiles = {each.name for each in (share / "config").glob("*.yaml")}
    assert {"indoor.yaml", "indoor_config.yaml"} <= profiles
    assert (share / "launch" / "robot_system.launch.py").exists()


@pytest.mark.parametrize("name", ["nothing_like_it"])
def test_unknown_package_has_no_share_folder(name: str) -> None:
    assert Workspace([]).share(name) is None
