"""Profiles from a server: downloaded without blocking the drawing thread, and named after their address."""

from __future__ import annotations

from pathlib import Path

from bot_console.tui.console.parameters.profile_store import ProfileStore

ADDRESS = "https://config.example/robots/fast.yaml?version=2"


def test_a_fetched_file_becomes_a_profile_named_after_its_address(tmp_path: Path) -> None:
    copy = tmp_path / "3f2a.yaml"
    copy.write_text("# For the track\n/robot: {ros__parameters: {speed: 2.0}}\n")
    profile_store = ProfileStore([], fetch=lambda address: copy)
    answer = profile_store.fetch(ADDRESS).result(240)
    assert (answer.ok, answer.text) == (True, "fast")
    assert [(each.name, each.title) for each in profile_store.profiles] == [("fast", f"For the track ({ADDRESS})")]
    copy.write_text("/robot: {ros__parameters: {speed: 3.0}}\n")
    profile_store.fetch(ADDRESS).result(240)
    assert dict(profile_store.profiles[0].values) == {("/robot", "speed"): 3.0}


def test_a_failed_download_is_reported(tmp_path: Path) -> None:
    def refused(address: str) -> Path:
        raise OSError(f"{address}: the server answers 404 Not Found")

    assert (
        ProfileStore([], fetch=refused).fetch(ADDRESS).result(240).text
        == f"{ADDRESS}: the server answers 404 Not Found"
    )
    assert "give the path of a file" in ProfileStore([]).fetch(ADDRESS).result(240).text


def test_a_downloaded_file_that_is_not_a_parameter_file_is_refused(tmp_path: Path) -> None:
    copy = tmp_path / "3f2a.yaml"
    copy.write_text("a: 1\n")
    answer = ProfileStore([], fetch=lambda address: copy).fetch(ADDRESS).result(240)
    assert not answer.ok
    assert "ros__parameters" in answer.text
