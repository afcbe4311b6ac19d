"""The newest image of a topic, which one thread receives and another one draws."""

from __future__ import annotations

from typing import Any

import pytest
from bot_console.tui.console.model import GraphInfo
from bot_console.tui.console.sensors import image_watch
from bot_console.tui.console.sensors.image_watch import ImageWatch
from sensor_msgs.msg import Image


def test_an_image_keeps_its_topic_if_another_one_is_chosen_while_it_is_converted(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    watch = ImageWatch(None)  # type: ignore[arg-type] -- no topic exists, so nothing is subscribed
    convert = image_watch._convert

    def chosen_meanwhile(*given: Any) -> Any:
        watch.watch_image("/left", 4, 4, GraphInfo())
        return convert(*given)

    monkeypatch.setattr(image_watch, "_convert", chosen_meanwhile)
    watch.watch_image("/right", 4, 4, GraphInfo())
    watch._take(Image(encoding="mono8", width=1, height=1, step=1, data=b"a"))
    assert (watch.picture().topic, watch.picture().topic) == ("/right", "/left")
    assert not watch.picture().pixels, "of the new topic nothing has been received"
