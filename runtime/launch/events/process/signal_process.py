"""A request to send a signal to a process."""

from __future__ import annotations

import signal
from typing import Any

from launch.events.process.process_targeted_event import ProcessTargetedEvent


class SignalProcess(ProcessTargetedEvent):
    """Requests that a process be sent a signal."""

    name = "launch.events.process.SignalProcess"

    def __init__(self, *, signal_number: str | signal.Signals, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__signal = signal_number

    @property
    def signal(self) -> Any:
        """The signal as given."""
        return self.__signal

    @property
    def signal_name(self) -> str:
        """The signal's name, such as `SIGINT`."""
        return self.__signal if isinstance(self.__signal, str) else signal.Signals(self.__signal).name
