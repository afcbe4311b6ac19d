"""How refusals are shown."""

from __future__ import annotations

import pytest
from bot_console.tui.console.model import SetOutcome
from bot_console.tui.text.refusals import beside_row, in_detail, of_many, of_one

REFUSED = SetOutcome("/robot", "max_speed", 9.5, False, "at most 2.0", "callback")
HELD_BACK = SetOutcome("/arm", "reach", 1.0, False, "/robot refused max_speed", "console")
TAKEN = SetOutcome("/arm", "reach", 1.0, True, "", "")


def test_refusal_is_shown_with_value_and_reason() -> None:
    assert beside_row(REFUSED) == "✗ 9.5: at most 2.0"
    assert in_detail(REFUSED) == "✗ 9.5 refused by the node: at most 2.0"
    assert of_one(REFUSED) == "/robot max_speed = 9.5 was refused: at most 2.0"


def test_a_value_without_an_answer_is_not_called_refused() -> None:
    unanswered = SetOutcome("/robot", "max_speed", 9.5, False, "/robot/set_parameters did not answer", "node")
    assert of_one(unanswered) == "/robot max_speed = 9.5 was not set: /robot/set_parameters did not answer"
    assert in_detail(unanswered) == "✗ 9.5 not set: /robot/set_parameters did not answer"
    assert "refused" not in of_many([unanswered])


@pytest.mark.parametrize("outcomes", [(HELD_BACK, REFUSED), (REFUSED, HELD_BACK), (TAKEN, REFUSED)])
def test_refusal_by_a_node_is_shown_among_many_outcomes(outcomes: tuple[SetOutcome, ...]) -> None:
    assert of_many(outcomes) == "Nothing was set: /robot max_speed = 9.5 was refused: at most 2.0"


def test_reason_of_the_console_is_shown_without_a_node_refusal() -> None:
    assert "reach = 1.0 was refused: /robot refused" in of_many([TAKEN, HELD_BACK])
    assert of_many([TAKEN]) == of_many([]) == ""


def test_control_characters_of_a_reason_are_removed() -> None:
    hostile = SetOutcome("/robot", "x", 1, False, "\x1b[2J", "descriptor")
    assert "\x1b" not in beside_row(hostile) + in_detail(hostile)
