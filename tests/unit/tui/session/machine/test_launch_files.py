"""The launch files of a robot's packages, in all spellings of ROS 2, found without blocking the caller."""

import threading
from pathlib import Path

import pytest
from bot_console.tui.session.machine.launch_files import LaunchFiles, launch_files

TIMEOUT_S = 240.0


def test_all_spellings_of_launch_files_are_found(tmp_path: Path, monkeypatch) -> None:
    share = tmp_path / "share"
    for name in ("launch/a.launch.py", "launch/bringup_launch.py", "b.launch.xml", "launch/deep/c.launch.yaml"):
        (share / "nav" / name).parent.mkdir(parents=True, exist_ok=True)
        (share / "nav" / name).touch()
    for name in ("launch/a.launch.pyc", "launch/launcher.py", "launch/launch.txt"):
        (share / "nav" / name).touch()
    index = share / "ament_index/resource_index/packages"
    index.mkdir(parents=True)
    (index / "nav").touch()
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    found = [Path(each).name for each in launch_files() if each.startswith(str(tmp_path))]
    assert found == ["b.launch.xml", "a.launch.py", "bringup_launch.py", "c.launch.yaml"]


def test_no_launch_files_without_a_prefix(monkeypatch: pytest.MonkeyPatch) -> None:
    def index() -> dict[str, str]:
        raise OSError("Environment variable 'AMENT_PREFIX_PATH' is not set or empty")  # As ROS 2's does.

    monkeypatch.delenv("AMENT_PREFIX_PATH", raising=False)
    monkeypatch.setattr("ament_index_python.packages.get_packages_with_prefixes", index)
    assert launch_files() == ()


def test_only_first_caller_waits_for_the_search() -> None:
    go_on, polls = threading.Semaphore(1), []

    def poll() -> tuple[str, ...]:
        assert go_on.acquire(timeout=TIMEOUT_S)
        polls.append(str(len(polls)))
        return tuple(polls)

    files = LaunchFiles(poll)
    assert files.now() == ("0",)  # This starts a second search, which has to wait.
    assert files.now() == ("0",) == files.now()
    go_on.release()
    while files.now() == ("0",):
        go_on.release()
    assert files.now()[:2] == ("0", "1")
    for _ in range(100):
        go_on.release()
