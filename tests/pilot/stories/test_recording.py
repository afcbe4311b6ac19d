"""R starts and stops recording, Z saves the last minutes; the status line shows the recording."""

from __future__ import annotations

from pathlib import Path

import pytest
from bot_console.tui.console.bags.port import RecordingInfo
from piloting import Session, run
from samples import live


def test_same_key_starts_and_stops_recording(tmp_path: Path) -> None:
    async def play(session: Session) -> None:
        await session.press("5", "R")
        assert "rosbag2_" in session.app.focused.value
        session.app.focused.value = str(tmp_path / "drive")
        await session.press("enter")
        assert ("record", str(tmp_path / "drive")) in session.console.asked
        session.app.pull()
        await session.settle()
        assert "● REC drive" in session.text()
        await session.press("R")
        session.app.pull()
        await session.settle()
        assert ("end", "") in session.console.asked and "REC" not in session.text()

    run(live(), play, (120, 40))


@pytest.mark.parametrize("key", ["R", pytest.param("Z", marks=pytest.mark.slow)])
def test_recording_does_not_offer_to_replace_an_existing_folder(
    key: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)

    async def play(session: Session) -> None:
        Path("taken").write_text("notes")
        session.console.change(recording=RecordingInfo(kept_s=120.0))
        await session.press("5", key)
        session.app.focused.value = "taken"
        await session.press("enter")
        assert "taken exists already" in " ".join(session.text().split())
        assert not [each for each in session.console.asked if each[0] in ("record", "keep")]
        session.app.focused.value = "free"
        await session.press("enter")
        assert [each[1] for each in session.console.asked if each[0] in ("record", "keep")] == ["free"]

    run(live(), play)


def test_last_minutes_are_saved_or_their_absence_reported(tmp_path: Path) -> None:
    async def play(session: Session) -> None:
        await session.press("2", "Z")
        assert ("keep", "") in session.console.asked, "the request is refused with the reason"
        session.console.change(recording=RecordingInfo(kept_s=120.0))
        await session.press("Z")
        assert "save the last 2 min" in session.text()
        session.app.focused.value = str(tmp_path / "was")
        await session.press("enter")
        assert ("keep", str(tmp_path / "was")) in session.console.asked

    run(live(), play, (120, 40))
