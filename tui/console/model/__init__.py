"""Frozen snapshots of a ROS system, as the panes see it.

Standard library only. Times are integer nanoseconds, distances m, angles rad, speeds m/s and rad/s. A part that has not
changed since the last snapshot is the same object, so a pane compares identity to know whether to redraw.
"""

from bot_console.tui.console.model.changes import RESTARTED, Change, ChangeSource, JournalState, SetOutcome
from bot_console.tui.console.model.graph import Endpoint, GraphInfo, IncompatiblePair, NodeInfo
from bot_console.tui.console.model.launch import (
    LaunchArgument,
    LaunchEvent,
    LaunchInfo,
    ProcessInfo,
    ProcessState,
    Program,
)
from bot_console.tui.console.model.logs import LogFilter, LoggerLevel, LogRecord, LogState, Severity, logger_of
from bot_console.tui.console.model.parameters import Kind, ParameterInfo, ParameterTree, Value, parameter_in, same
from bot_console.tui.console.model.profiles import Profile, ProfileDifference
from bot_console.tui.console.model.range import Range
from bot_console.tui.console.model.rates import RateCheck
from bot_console.tui.console.model.snapshot import Capabilities, ConsoleSnapshot, LinkInfo

__all__ = [
    "RESTARTED",
    "Capabilities",
    "Change",
    "ChangeSource",
    "ConsoleSnapshot",
    "Endpoint",
    "GraphInfo",
    "IncompatiblePair",
    "JournalState",
    "Kind",
    "LaunchArgument",
    "LaunchEvent",
    "LaunchInfo",
    "LinkInfo",
    "LogFilter",
    "LogRecord",
    "LogState",
    "LoggerLevel",
    "NodeInfo",
    "ParameterInfo",
    "ParameterTree",
    "ProcessInfo",
    "ProcessState",
    "Profile",
    "ProfileDifference",
    "Program",
    "Range",
    "RateCheck",
    "SetOutcome",
    "Severity",
    "Value",
    "logger_of",
    "parameter_in",
    "same",
]
