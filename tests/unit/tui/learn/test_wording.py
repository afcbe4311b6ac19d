"""What a step waits for, and what has been done, is described in plain English."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from bot_console.tui.learn.activity import Activity
from bot_console.tui.learn.condition_check import missing
from bot_console.tui.learn.condition_syntax import VERBS, Condition, read_condition
from bot_console.tui.learn.course import COURSES, read_course
from bot_console.tui.learn.files import WorkspaceFiles
from bot_console.tui.learn.wording import command_text, fulfilled_text


@pytest.mark.parametrize(
    ("condition", "text"),
    [
        ("saw-node *", "there is a node"),
        ("saw-node robot with speed as node", "there is node /robot with a parameter speed"),
        ("saw-parameter speed", "speed has been declared"),
        ("saw-parameter speed described limited", "speed has a description and a range"),
        ("saw-parameter speed == 2.0", "speed has the value 2.0"),
        ("saw-set speed", "speed was set"),
        ("saw-set speed 2.0", "speed was set to 2.0"),
        ("saw-refused speed", "a value of speed was refused"),
        ("saw-refused speed 'too fast'", "a value of speed was refused: too fast"),
        ("saw-command service call /add *AddTwoInts *a:*", "service call /add … AddTwoInts … a: … was run"),
        ("saw-failure run *.py speed:=2", "run *.py speed:=2 has failed"),
        ("saw-launch *.launch.py", "*.launch.py was launched"),
        ("saw-launch *.launch.py speed:=* contains Node", "*.launch.py with speed:=… and Node was launched"),
        ("saw-launch a.launch.py *:=*indoor*", "a.launch.py with an argument that contains indoor was launched"),
        ("saw-topic *", "there is a topic"),
        ("saw-pane graph", "the pane graph was opened"),
        ("saw-pane plugin_*", "a pane of a package was opened"),
        ("saw-curve turn_rate", "a curve of turn_rate was plotted"),
        ("saw-layout *", "a layout was saved"),
        ("saw-profile indoor", "a profile indoor was applied"),
        ("saw-steering", "your keys drove the robot"),
        ("saw-move 0.5", "the robot drove 0.5 m"),
        ("expect-file a.py", "there is a.py"),
        ("expect-file a.py contains Node", "a.py contains Node"),
        ("expect-file a.py lacks Node", "a.py does not contain Node"),
        ("expect-entry-point *", "setup.py has a console script"),
        ("expect-installed config/*.yaml", "data_files installs config/*.yaml"),
        ("expect-parameter-file a.yaml", "a.yaml gives parameters"),
        ("expect-parameter-file a.yaml speed 2.0", "a.yaml gives speed the value 2.0"),
        ("expect-no-findings a.launch.py", "lint finds nothing in a.launch.py"),
    ],
)
def test_fulfilled_condition_is_described_in_a_sentence(condition: str, text: str) -> None:
    read = read_condition(condition)
    assert fulfilled_text(read.verb, read.words) == text


def test_anything_between_words_of_a_command_is_shown_as_one_ellipsis() -> None:
    assert command_text(["run", "*", "--params-file", "*indoor*", "*"]) == "run … --params-file … indoor …"


@pytest.mark.parametrize(
    "condition", [each for step in read_course(COURSES / "week6").steps() for each in step.conditions]
)
def test_course_shows_no_condition_verbs_and_only_file_name_patterns(condition: Condition, tmp_path: Path) -> None:
    waits = missing(condition, Activity(), WorkspaceFiles(tmp_path), {})
    for text in (waits, fulfilled_text(condition.verb, condition.words)):
        assert not any(verb in text for verb in VERBS)
        assert not re.search(r"\*(?![^ ]*\.(py|yaml))|\*[^ ]*:=|:=[^ ]*\*", text), text
