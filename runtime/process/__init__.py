"""Node processes: threads that each look to their code like a process of its own. Knows no ROS."""

from bot_console.runtime.process.clock_source import ClockSource, RealTime, Wakeup
from bot_console.runtime.process.current import NodeProcess, ProcessLocal, current

__all__ = ["ClockSource", "NodeProcess", "ProcessLocal", "RealTime", "Wakeup", "current"]
