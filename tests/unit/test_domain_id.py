"""The domain ID from the environment."""

from __future__ import annotations

import pytest
from bot_console.runtime.domain_id import domain_id


@pytest.mark.parametrize(("text", "number"), [("", 0), ("0", 0), ("42", 42), ("4294967295", 4294967295)])
def test_number_is_a_domain_id(monkeypatch: pytest.MonkeyPatch, text: str, number: int) -> None:
    monkeypatch.setenv("ROS_DOMAIN_ID", text)
    assert domain_id() == number


@pytest.mark.parametrize("text", ["x", "-1", "1.5", "0x1", "٣", "²", " 1", pytest.param("9" * 5000, id="long")])
def test_anything_else_is_rejected_with_a_short_message(monkeypatch: pytest.MonkeyPatch, text: str) -> None:
    monkeypatch.setenv("ROS_DOMAIN_ID", text)
    with pytest.raises(ValueError, match=r"ROS_DOMAIN_ID is '.{1,40}', not a number"):
        domain_id()
