"""The domain ID from the environment; the numbers were recorded from rclpy of Jazzy."""

from __future__ import annotations

import pytest
from bot_console.runtime.domain_id import domain_id


@pytest.mark.parametrize(
    ("text", "number"),
    [
        ("", 0),
        ("0", 0),
        ("42", 42),
        ("4294967295", 4294967295),
        ("05", 5),
        ("0x5", 5),
        ("5 ", 5),
        (" 5", 5),
        ("\t5", 5),
        ("5\n", 5),
        ("+5", 5),
        ("5a", 5),
        ("5.0", 5),
        ("1e2", 1),
        ("-0", 0),
        ("-1", 0),
        ("18446744073709551615", 0),
        ("-18446744073709551611", 5),
    ],
)
def test_number_is_read_as_rcl_reads_it(monkeypatch: pytest.MonkeyPatch, text: str, number: int) -> None:
    monkeypatch.setenv("ROS_DOMAIN_ID", text)
    assert domain_id() == number


@pytest.mark.parametrize(
    "text", ["x", "0o5", "--5", "0 x", "٣", "²", "18446744073709551616", "-2", pytest.param("9" * 5000, id="long")]
)
def test_anything_else_is_rejected_with_a_short_message(monkeypatch: pytest.MonkeyPatch, text: str) -> None:
    monkeypatch.setenv("ROS_DOMAIN_ID", text)
    with pytest.raises(ValueError, match=r"ROS_DOMAIN_ID is '.{1,40}', not a number"):
        domain_id()
