"""The `tune` command: wrong usage in one line, saving the best as a profile, and the result as JSON."""

from __future__ import annotations

import json
from argparse import Namespace
from pathlib import Path

import pytest
from bot_console.tui.cli.tune import run as tune
from bot_console.tui.cli.tune.results import result_data, result_line
from bot_console.tui.tuning.job import Progress, SettingResult
from bot_console.tui.tuning.score import FAILED, parse_score
from bot_console.tui.tuning.specification import TuningSpecification
from bot_console.tui.tuning.tunable import Tunable

SPEED = Tunable("/robot_navigator", "max_speed", "double", 0.1, 5.0, 1.0, "m/s")
QUESTION = TuningSpecification((SPEED,), parse_score("swift"))
NOW = SettingResult((1.0,), 0.8, (0.7, 0.9))
BEST = SettingResult((2.5,), 1.2, (1.2, 1.2))
WORST = SettingResult((5.0,), FAILED, (), problem="seed 1: robot_node ended")
BUMPED = SettingResult((4.0,), -1.0, (-1.0, -1.0), 3)


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (["max_speed", "--score", "spede"], "--score: 'spede' is not a score"),
        (["max_speed", "--profile", "moon"], "there is no profile 'moon'; profiles: competition"),
        (["max_speed", "--search", "luck"], "invalid choice"),
        ([], "required"),
    ],
)
def test_wrong_usage_ends_before_anything_runs(
    words: list[str], why: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(tune, "Pool", None)
    with pytest.raises(SystemExit) as ended:
        tune.run(words)
    assert ended.value.code == 2
    assert why in capsys.readouterr().err


def test_each_setting_is_printed_on_a_line() -> None:
    assert result_line(QUESTION, BEST) == "   1.200  max_speed 2.5"
    assert result_line(QUESTION, BUMPED).endswith("3 collisions")
    assert result_line(QUESTION, WORST) == "  failed  max_speed 5.0  seed 1: robot_node ended"


def test_result_reports_gain_and_whether_it_holds_on_other_seeds() -> None:
    worse = SettingResult((2.5,), 0.6, (0.6,))
    result = result_data(QUESTION, Progress((NOW, BEST, WORST), 9, 9, 3.0, 9, (NOW, worse), True))
    assert result["best"]["values"] == {"/robot_navigator:max_speed": 2.5}
    assert result["worst"]["score"] is None
    assert result["complete"]
    assert "+50%" in result["text"][1]
    assert result["text"][2] == "on 2 other seeds: 0.800 → 0.600  -25%"
    assert "no better" in result["text"][3]
    json.dumps(result)


@pytest.mark.parametrize(("name", "code"), [("swift one", 0), ("../up", 1)])
def test_best_setting_is_saved_as_profile_with_original_comments(
    name: str, code: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("BOT_CONSOLE_USER_DIR", str(tmp_path))
    progress = Progress((NOW, BEST), 9, 9, 3.0, 9, (NOW, BEST), True)
    assert tune._print_result(QUESTION, progress, Namespace(json=False, save=name)) == code
    message = capsys.readouterr().err
    if code:
        assert "is not a valid profile name" in message
        return
    text = (tmp_path / "config" / "profiles" / "swift one.yaml").read_text()
    assert text.startswith("# indoor, tuned for swift: score 1.200\n# Indoor: low speed")
    assert "max_speed: 2.5 " in text
    assert 'robot_name: "IndoorBot"' in text


@pytest.mark.parametrize("progress", [Progress((WORST,), ended=True, problem="every setting failed"), Progress()])
def test_exit_code_is_1_without_a_result(progress: Progress) -> None:
    assert tune._print_result(QUESTION, progress, Namespace(json=True, save="")) == 1
