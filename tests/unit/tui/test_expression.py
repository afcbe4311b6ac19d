"""Expressions and units: arithmetic and nothing else, and no unit is guessed."""

from __future__ import annotations

import math

import pytest
from bot_console.tui.console.model import Kind, ParameterInfo, Range, Value
from bot_console.tui.panes.parameters.editing import at_share, moved_by_steps, typed_element, typed_value
from bot_console.tui.text.expression.numbers import evaluate


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("0.5*2", 1.0),
        ("2**10", 1024),
        ("-(3+4)//2", -4),
        ("sqrt(16)", 4.0),
        ("min(3, 2)", 2),
        ("pi", math.pi),
        ("x/2", 3),
    ],
)
def test_arithmetic_is_evaluated(text: str, value: float) -> None:
    assert evaluate(text, {"x": 6}) == value


@pytest.mark.parametrize(
    "text",
    [
        "__import__('os')",
        "(1).real",
        "[1]",
        "x",
        "1 if 1 else 2",
        "'a'*9",
        "lambda: 1",
        "True",
        "1<2",
        "open(1)",
        "9**9**9**9",
        "2**100000",
        "(" * 60 + "1",
        "1/0",
        "1e308*10*0 if",
        "sqrt(-1)",
        "(-8)**0.5",
        "round()",
    ],
)
def test_everything_but_arithmetic_is_rejected_with_a_reason(text: str) -> None:
    with pytest.raises(ValueError, match=r"\w+ \w+"):
        evaluate(text)


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("0.3*", r"'0\.3\*' is incomplete: a number must follow \*$"),
        ("max(1,", "incomplete: a number must follow ,"),
        ("(1 + 2", "incomplete: a closing bracket is missing"),
        (" ", "a number is expected, but nothing was typed"),
        ("1 2", "not a number: an operator is expected at '2'"),
        ("2 * ]", r"not a number: a number must follow \* at '\]'"),
    ],
)
def test_refusal_names_the_missing_part_and_its_place(text: str, why: str) -> None:
    with pytest.raises(ValueError, match=why):
        evaluate(text)


def of(kind: Kind, unit: str, limits: Range | None = None, value: Value = 1.0) -> ParameterInfo:
    return ParameterInfo("/n", "p", kind, value, f"What it is for ({unit})", range=limits)


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("30 cm", "m", 0.3),
        ("0.5*2", "m", 1.0),
        ("2*25cm", "m", 0.5),
        ("90 deg", "rad", math.pi / 2),
        ("36 km/h", "m/s", 10.0),
        ("60 rpm", "rad/s", 2 * math.pi),
        ("250 ms", "s", 0.25),
        ("2 m", "m", 2.0),
        ("1e3", "m", 1000.0),
        (".inf", "m", math.inf),
        ("50 %", "", 0.5),
        ("30 1/min", "Hz", 0.5),
        ("2 g0", "m/s²", 19.6133),
        ("(1+1) cm", "m", 0.02),
        ("0x1F", "m", 31.0),
        ("0x1F", "", 31.0),
        ("0x10 cm", "m", 0.16),
        ("0b11 cm", "m", 0.03),
        ("1e5", "", 1e5),
        ("1e2 cm", "m", 1.0),
        ("1e2cm", "m", 1.0),
    ],
)
def test_number_with_unit_is_converted_to_the_parameters_unit(text: str, unit: str, value: float) -> None:
    found = typed_value(text, of(Kind.DOUBLE, unit))
    assert found == pytest.approx(value) and isinstance(found, float)


@pytest.mark.parametrize(("text", "unit"), [("3 kg", "m"), ("3 cm", ""), ("3 parsec", "m"), ("cm", "m"), ("", "m")])
def test_incompatible_unit_is_reported(text: str, unit: str) -> None:
    with pytest.raises(ValueError, match=r"unit|number"):
        typed_value(text, of(Kind.DOUBLE, unit))


@pytest.mark.parametrize("unit", ["", "m"])
@pytest.mark.parametrize("kind", [Kind.DOUBLE, Kind.INTEGER])
@pytest.mark.parametrize("text", ["1e400", "-1e400", "1E999", "1e", "2.5E", "0x", "0b12", "0xg", "0o8", "1_", "3e5x"])
def test_invalid_number_is_not_taken_for_one_with_a_unit(text: str, unit: str, kind: Kind) -> None:
    with pytest.raises(ValueError, match=r"is not a number|is too large") as refused:
        typed_value(text, of(kind, unit))
    assert "unit" not in str(refused.value)


def test_decimal_comma_is_reported_with_the_intended_number() -> None:
    with pytest.raises(ValueError, match=r"^decimals have a point: 2\.5$"):
        typed_value("2,5", of(Kind.DOUBLE, "m"))


def test_integers_stay_whole() -> None:
    assert typed_value("360/4*2", of(Kind.INTEGER, "", value=1)) == 180
    with pytest.raises(ValueError, match="not an integer"):
        typed_value("1/3", of(Kind.INTEGER, "", value=1))
    with pytest.raises(ValueError, match="64 bits"):
        typed_value("2**63*1", of(Kind.INTEGER, "", value=1))


@pytest.mark.parametrize(
    ("kind", "unit", "text", "value"),
    [
        (Kind.DOUBLE_ARRAY, "m", "30 cm", 0.3),
        (Kind.INTEGER_ARRAY, "", "360/4", 90),
        (Kind.BYTE_ARRAY, "", "0xff", b"\xff"),
        (Kind.STRING_ARRAY, "", "1+1", "1+1"),
        (Kind.BOOL_ARRAY, "", "yes", True),
    ],
)
def test_element_of_numbers_may_be_an_expression(kind: Kind, unit: str, text: str, value: Value) -> None:
    assert typed_element(of(kind, unit), text) == value


@pytest.mark.parametrize(
    ("kind", "text", "problem"),
    [(Kind.BYTE_ARRAY, "1+1", "not a byte"), (Kind.BOOL_ARRAY, "2", "neither"), (Kind.INTEGER_ARRAY, "1/2", "integer")],
)
def test_element_of_another_type_is_refused(kind: Kind, text: str, problem: str) -> None:
    with pytest.raises(ValueError, match=problem):
        typed_element(of(kind, ""), text)


def test_steps_and_shares_stay_in_the_range() -> None:
    speed = of(Kind.DOUBLE, "m/s", Range(0.1, 5.0))
    assert moved_by_steps(speed, 4.9, 10) == 5.0 and moved_by_steps(speed, 1.0, 1) == 1.05
    assert (at_share(speed, 0), at_share(speed, 1), at_share(speed, 2)) == (0.1, 5.0, 5.0)
    beams = of(Kind.INTEGER, "", Range(3, 3600, 3), 360)
    assert at_share(beams, 0.5) == 1803 and moved_by_steps(beams, 360, -1) == 357
    assert at_share(of(Kind.DOUBLE, "m"), 0.5) is None and moved_by_steps(speed, True, 1) is None
