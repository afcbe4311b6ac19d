"""Profiles on a command line: by name from every folder in which the Profiles pane looks, or by path."""

from __future__ import annotations

from pathlib import Path

import pytest
from bot_console.runtime.workspace import discover
from bot_console.tui.cli.arguments import Options, attach_parser, parse, parse_attach
from bot_console.tui.cli.completion import candidates
from bot_console.tui.files.folders import OVERRIDE
from bot_console.tui.session.embedded.named_profile import NoProfileError, named_profile
from bot_console.tui.session.embedded.workspaces import choose

VALUES = "# Slow: for a narrow room\nrobot_navigator:\n  ros__parameters:\n    max_speed: 0.3\n"
LAUNCHES = "launch: my.launch.py\narguments:\n  speed: 3\n  careful: true\n"


@pytest.fixture(autouse=True)
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv(OVERRIDE, str(tmp_path / "user"))
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(discover, "_current", [])
    return tmp_path


def saved(folder: Path, name: str = "slow.yaml", text: str = VALUES) -> str:
    folder.mkdir(parents=True, exist_ok=True)
    (folder / name).write_text(text)
    return str(folder / name)


def parse_words(*words: str) -> Options:
    return parse([*words])


@pytest.mark.parametrize("words", [["--profiles", "mine", "--profile", "slow"], ["slow", "--profiles", "mine"]])
def test_profile_of_a_given_folder_is_found_by_name(place: Path, words: list[str]) -> None:
    path = saved(place / "mine")
    options = parse_words("--headless", *words)
    assert (options.profile, options.profile_file) == ("slow", path)
    assert options.profile_arguments == {"config_file": path}


@pytest.mark.parametrize(
    "word", ["./slow.yaml", "slow.yaml", "mine/../slow.yaml", "~/slow.yaml"], ids=["here", "bare", "indirect", "home"]
)
def test_profile_is_found_by_path(place: Path, word: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("HOME", str(place))
    path = saved(place)
    (place / "mine").mkdir()
    assert Path(parse_words(word).profile_file).resolve() == Path(path)
    assert Path(parse_words("rqt_plot", "/odom/x", word).profile_file).resolve() == Path(path)


def test_profile_saved_in_the_console_is_found_by_name(place: Path) -> None:
    path = saved(place / "user" / "config" / "profiles")
    assert parse_words("slow").profile_file == path
    assert "slow" in candidates(["bot-console", "--profile", ""][1:])


def test_profile_of_a_package_in_the_workspace_is_found_by_name(place: Path) -> None:
    package = place / "src" / "my_robot"
    path = saved(package / "config", "narrow.yml")
    (package / "package.xml").write_text("<package><name>my_robot</name></package>")
    (package / "setup.py").write_text("from setuptools import setup\nsetup(name='my_robot')\n")
    choose([place])
    assert parse_words("narrow").profile_file == path


def test_profile_of_the_robot_keeps_its_name(place: Path) -> None:
    saved(place / "mine", "indoor.yaml")
    options = parse_words("indoor", "--profiles", "mine")
    assert options.profile_file == "" and options.profile_arguments == {"profile": "indoor"}


def test_launch_profile_runs_its_launch_file_and_given_arguments_win(place: Path) -> None:
    saved(place, "other.yaml", LAUNCHES)
    saved(place, "my.launch.py", "")
    options = parse_words("other.yaml", "careful:=false")
    assert options.launch == str(place / "my.launch.py")
    assert options.launch_arguments == {"speed": "3", "careful": "false"}


@pytest.mark.parametrize(
    ("words", "reported"),
    [
        (["fast"], "there is no profile 'fast'; profiles: competition, indoor, outdoor, slow, warehouse"),
        (["./fast.yaml"], "there is no file ./fast.yaml"),
        (["https://config.example/robot.yaml"], "https://config.example/robot.yaml is an address"),
        (["broken.yaml"], "broken.yaml cannot be used as a profile: line 2: not YAML"),
    ],
)
def test_missing_or_unusable_profile_is_reported(place: Path, words: list[str], reported: str) -> None:
    saved(place / "mine")
    saved(place, "broken.yaml", "a: [\n")
    with pytest.raises(NoProfileError) as error:
        named_profile(*words, [Path("mine")])
    assert str(error.value).startswith(reported)


def test_missing_folder_of_profiles_is_named() -> None:
    with pytest.raises(NoProfileError, match="there is no folder nowhere"):
        named_profile("slow", [Path("nowhere")])


def test_attached_console_accepts_a_folder_of_profiles() -> None:
    options, _ = parse_attach(["--profiles", "mine"], attach_parser())
    assert options.profile_folders == [Path("mine")]


def test_profiles_are_completed_for_every_command_that_takes_one(place: Path) -> None:
    saved(place / "mine")
    assert candidates(["--profiles", "mine", "--profile", "sl"]) == ["slow"]
    assert candidates(["tune", "max_speed", "--profiles", "mine", "--profile", ""])[-2:] == ["slow", "warehouse"]
    assert candidates(["up", "--profiles", "mine", "sl"]) == ["slow"]
    assert "outdoor" in candidates(["ou"])


def test_path_with_a_too_long_name_counts_as_missing() -> None:
    with pytest.raises(NoProfileError, match="there is no file"):
        named_profile("./in" + "9" * 400)
