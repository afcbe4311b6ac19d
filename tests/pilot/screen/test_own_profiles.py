"""A person's own profiles are overwritten, renamed and deleted after a question; other profiles are protected."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from bot_console.tui.console.model import Profile
from bot_console.tui.screens.confirm import ConfirmScreen
from piloting import Session, run
from samples import live

SEEN = 1_700_000_000


def system_with_own_profile(folder: Path) -> tuple:
    """A system with a profile of the person's own after the robot's; it is the last one."""
    console, launcher = live()
    file = folder / "zz_hall.yaml"
    file.write_text("/robot_navigator:\n  ros__parameters: {turn_rate: 0.5}\n")
    os.utime(file, (SEEN, SEEN))
    hall = Profile("zz_hall", str(file), "For the hall.", {("/robot_navigator", "turn_rate"): 0.5}, own=True)
    console.change(profiles=(*console.current.profiles, hall))
    return console, launcher


def profile_requests(session: Session) -> list[tuple]:
    return [each for each in session.console.asked if str(each[0]).endswith(" profile")]


def test_overwriting_a_profile_asks_with_file_and_time(tmp_path: Path) -> None:
    async def play(session: Session) -> None:
        await session.press("7", "S")
        await session.paste("zz_hall")
        await session.press("enter")
        assert isinstance(session.app.screen, ConfirmScreen)
        text = session.text()
        assert "Overwrite the profile zz_hall?" in text and "zz_hall.yaml" in text
        assert "changed 2023-11-1" in text, "when it was changed"
        await session.press("n")
        assert profile_requests(session) == []
        await session.press("S")
        await session.paste("zz_hall")
        await session.press("enter", "y")
        assert profile_requests(session) == [("save profile", "zz_hall", "")]

    run(system_with_own_profile(tmp_path), play, (120, 40))


@pytest.mark.slow
def test_invalid_profile_name_is_rejected() -> None:
    async def play(session: Session) -> None:
        await session.press("7", "S")
        await session.paste("../hall")
        await session.press("enter")
        assert "is not a valid profile name" in session.text() and "what ../hall is for" not in session.text()
        await session.press("escape", "S")
        await session.paste(" ")
        await session.press("enter")
        assert "a profile needs a name" in session.text() and profile_requests(session) == []

    run(live(), play, (120, 40))


def test_profile_is_renamed_unless_the_name_is_taken(tmp_path: Path) -> None:
    system = system_with_own_profile(tmp_path)
    console = system[0]
    console.change(profiles=(Profile("attic", "/home/attic.yaml", own=True), *console.current.profiles))

    async def play(session: Session) -> None:
        await session.press("7", "G", "m")
        await session.paste("attic")
        await session.press("enter")
        assert "there is already a profile attic" in session.text() and profile_requests(session) == []
        await session.press("escape", "m")
        await session.paste("cellar")
        await session.press("enter")
        assert profile_requests(session) == [("rename profile", "zz_hall", "cellar")]

    run(system, play, (120, 40))


def test_profile_is_deleted_after_a_question(tmp_path: Path) -> None:
    async def play(session: Session) -> None:
        await session.press("7", "G", "d")
        text = session.text()
        assert "Delete the profile zz_hall?" in text and "changed 2023-11-1" in text
        await session.press("n")
        assert profile_requests(session) == []
        await session.press("d", "y")
        assert profile_requests(session) == [("delete profile", "zz_hall")] and "zz_hall is deleted" in session.text()

    run(system_with_own_profile(tmp_path), play, (80, 24))


def test_built_in_profiles_are_neither_renamed_nor_deleted() -> None:
    async def play(session: Session) -> None:
        await session.press("7", "d")
        assert len(session.app.screen_stack) == 1 and "cannot be deleted: only profiles saved with S" in session.text()
        await session.press("m")
        assert "cannot be renamed: only profiles saved with S" in session.text() and profile_requests(session) == []

    run(live(), play, (120, 40))
