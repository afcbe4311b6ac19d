"""Types that are not installed."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from bot_console.runtime.interfaces import type_inquiry
from ros2cli.type_discovery import message_class


def test_a_type_that_no_node_can_describe_is_reported_with_the_reason(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(type_inquiry, "inquiries", lambda *_: {})
    node: Any = SimpleNamespace(context=SimpleNamespace(get_domain_id=lambda: 0))
    reason = message_class(node, "/things", "nobody_msgs/msg/Thing")
    assert "'nobody_msgs/msg/Thing' of topic '/things' is not installed here: no node publishes it" in reason
