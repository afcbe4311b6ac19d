"""`T` in the Parameters pane: the questions, the progress of a tuning, and its best setting."""

from __future__ import annotations

from bot_console.tui.console.answer import Answer
from bot_console.tui.panes.parameters.table import ParameterRows
from bot_console.tui.screens.tuning_progress import SettingRows, TuningScreen
from bot_console.tui.tuning.job import Progress, SettingResult
from bot_console.tui.tuning.score import FAILED
from bot_console.tui.tuning.specification import TuningSpecification
from bot_console.tui.tuning.tunable import Setting
from piloting import Session, run
from samples import live

NOW = SettingResult((1.0,), 0.8, (0.8,))
BEST = SettingResult((0.5,), 1.5, (1.5,))
BUMPED = SettingResult((2.0,), -1.0, (-1.0,), 2)
BROKEN = SettingResult((3.0,), FAILED, (), problem="seed 1: refused")


class FakeTuning:
    def __init__(self) -> None:
        self.progress = Progress()
        self.stopped = False
        self.saved: list[tuple[str, Setting]] = []

    def stop(self) -> None:
        self.stopped = True

    def save(self, name: str, setting: Setting) -> Answer:
        self.saved.append((name, setting))
        return Answer(True, f"saved as profile {name}")


class FakeTuner:
    def __init__(self) -> None:
        self.asked: list[TuningSpecification] = []
        self.tuning = FakeTuning()

    def problem(self, question: TuningSpecification) -> str:
        return ""

    def begin(self, question: TuningSpecification) -> FakeTuning:
        self.asked.append(question)
        return self.tuning


async def begin(session: Session) -> FakeTuner:
    """Go to the speed and answer all questions."""
    session.app.tuner = tuner = FakeTuner()
    await session.press("1")
    rows = session.pane(ParameterRows)
    at = next(index for index, row in enumerate(rows.rows) if row.parameter and row.parameter.name == "max_speed")
    rows.cursor = at
    await session.press("T", "enter")
    await session.paste("swift")
    await session.press("enter", "enter")
    return tuner


async def show_progress(session: Session, tuner: FakeTuner, progress: Progress) -> None:
    tuner.tuning.progress = progress
    screen = session.app.screen
    assert isinstance(screen, TuningScreen)
    screen.poll()
    await session.settle()


def test_best_setting_is_found_shown_and_applied() -> None:
    async def play(session: Session) -> None:
        tuner = await begin(session)
        question = tuner.asked[0]
        assert [each.name for each in question.tunables] == ["max_speed"]
        assert (question.score.text, question.runs, question.duration) == ("swift", 60, 60.0)
        await show_progress(session, tuner, Progress((NOW, BUMPED), 20, 70, 10.0, 20))
        assert "20 of 70 runs, about 25 s left" in session.text()
        rows = (NOW, BUMPED, BEST, BROKEN)
        await show_progress(session, tuner, Progress(rows, 70, 70, 40.0, 70, (NOW, BEST), True))
        text = session.text()
        assert "70 of 70 runs, done" in text
        assert "on 1 other seed 0.800 → 1.500" in text
        assert "2 collisions" in text
        assert "failed" in text
        assert session.app.screen.query_one(SettingRows).rows[0] is BEST
        await session.press("enter")
        assert session.console.asked[-1][:2] == ("set_all", {"/robot_navigator": {"max_speed": 0.5}})
        assert not isinstance(session.app.screen, TuningScreen)

    run(live(), play, (100, 30))


def test_setting_is_saved_as_profile_and_second_escape_ends_the_runs() -> None:
    async def play(session: Session) -> None:
        tuner = await begin(session)
        await show_progress(session, tuner, Progress((NOW, BEST), 20, 70, 10.0, 20))
        await session.press("down", "S", "ctrl+u")
        await session.paste("quick")
        await session.press("enter")
        assert tuner.tuning.saved == [("quick", (1.0,))]
        assert "saved as profile quick" in session.text()
        await session.press("escape")
        assert "esc again ends them" in session.text()
        assert not tuner.tuning.stopped
        await session.press("escape")
        assert tuner.tuning.stopped
        assert not isinstance(session.app.screen, TuningScreen)
        assert "enter Edit" in session.lines()[-1]

    run(live(), play)


def test_missing_tuner_is_reported_before_any_question() -> None:
    async def play(session: Session) -> None:
        session.app.tuner = None
        await session.press("1", "T")
        assert "Tuning is not available" in session.text() and "tune within" not in session.text()

    run(live(), play)
