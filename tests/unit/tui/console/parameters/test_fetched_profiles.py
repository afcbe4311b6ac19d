"""Profiles from a server: taken in beside the thread that draws, named by their address."""

from __future__ import annotations

from pathlib import Path

from bot_console.tui.console.parameters.profile_store import ProfileStore

ADDRESS = "https://config.example/robots/fast.yaml?version=2"


def test_what_was_fetched_is_a_profile_by_the_name_of_its_address(tmp_path: Path) -> None:
    copy = tmp_path / "3f2a.yaml"
    copy.write_text("# For the track\n/robot: {ros__parameters: {speed: 2.0}}\n")
    profile_store = ProfileStore([], fetch=lambda address: copy)
    answer = profile_store.fetch(ADDRESS).result(10)
    assert (answer.ok, answer.text) == (True, "fast")
    assert [(each.name, each.title) for each in profile_store.profiles] == [("fast", f"For the track ({ADDRESS})")]
    copy.write_text("/robot: {ros__parameters: {speed: 3.0}}\n")
    profile_store.fetch(ADDRESS).result(10)
    assert dict(profile_store.profiles[0].values) == {("/robot", "speed"): 3.0}


def test_why_nothing_was_fetched_is_reported(tmp_path: Path) -> None:
    def refused(address: str) -> Path:
        raise OSError(f"{address}: the server answers 404 Not Found")

    assert (
        ProfileStore([], fetch=refused).fetch(ADDRESS).result(10).text == f"{ADDRESS}: the server answers 404 Not Found"
    )
    assert "give the path of a file" in ProfileStore([]).fetch(ADDRESS).result(10).text


def test_what_is_no_parameter_file_is_reported(tmp_path: Path) -> None:
    copy = tmp_path / "3f2a.yaml"
    copy.write_text("a: 1\n")
    answer = ProfileStore([], fetch=lambda address: copy).fetch(ADDRESS).result(10)
    assert not answer.ok
    assert "ros__parameters" in answer.text
