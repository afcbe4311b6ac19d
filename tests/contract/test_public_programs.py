"""A hundred small programs, as in tutorials and examples, end here as on the real rclpy of Jazzy.

`live/programs.json` has their output, log lines and exit codes there; `live/programs.yaml` lists the programs that
differ here, and why. `python tools/compare_programs.py REAL_PYTHON` runs both side by side.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest
from domains import unused_domain
from helpers.recorded.programs import differing, names, outcome, recorded
from rigs import is_embedded_rclpy

DEFAULT_RUN, EACH_CHANGE = 60, 20
"""One in 60 programs is in the default run, one in 20 runs with `-m slow`, and the others with `-m soak`."""
OURS = [str(Path(sys.executable).with_name("bot-console")), "run"]
ADDED_IN_3_13 = " and no __dict__ for setting new attributes"
"""What Python 3.13 appends to a message of the interpreter."""
pytestmark = pytest.mark.timeout(180)


def programs() -> list[object]:
    """The names of all programs, with the mark of the run to which each belongs."""
    shares = ((DEFAULT_RUN, ()), (EACH_CHANGE, pytest.mark.slow), (1, pytest.mark.soak))
    return [
        pytest.param(each, marks=next(marks for share, marks in shares if number % share == 0))
        for number, each in enumerate(names())
    ]


@pytest.mark.skipif(not is_embedded_rclpy(), reason="tests our rclpy")
@pytest.mark.parametrize("name", programs())
def test_program_ends_as_on_the_real_rclpy(name: str) -> None:
    ours, real = outcome(OURS, name, unused_domain()), recorded()[name]
    ours = ours._replace(printed=ours.printed.replace(ADDED_IN_3_13, ""))
    if name in differing():
        assert ours != real, f"{name} no longer differs: remove it from programs.yaml"
    else:
        assert ours == real


@pytest.mark.ros
@pytest.mark.skipif(is_embedded_rclpy(), reason="needs the rclpy of PyPI: .ci/on_rclpy")
@pytest.mark.skipif(os.environ.get("BOT_CONSOLE_TESTS_DISTRO", "jazzy") != "jazzy", reason="recorded on Jazzy")
@pytest.mark.parametrize("name", names())
def test_program_ends_as_recorded(name: str) -> None:
    assert outcome([sys.executable], name, unused_domain()) == recorded()[name]


def test_every_program_is_recorded_and_every_difference_has_a_reason() -> None:
    assert names() == sorted(recorded())
    assert set(differing()) <= set(names()) and all(differing().values())
