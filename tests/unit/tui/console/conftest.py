"""A ROS domain that a test shares with the console that it starts."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from bot_console.tui.console.robot import robot_drive
from domains import unused_domain
from rclpy.context import Context


@pytest.fixture
def shared_context(monkeypatch: pytest.MonkeyPatch) -> Iterator[Context]:
    """A context in an unused domain, which a console of this process joins too; the console closes without waiting."""
    domain = unused_domain()
    monkeypatch.setenv("ROS_DOMAIN_ID", str(domain))
    monkeypatch.setattr(robot_drive, "LAST_ZERO_TIMEOUT_S", 0.0)
    context = Context()
    context.init(domain_id=domain)
    yield context
    context.try_shutdown()
