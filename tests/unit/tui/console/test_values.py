"""Parameter values of messages, which may contain anything."""

from bot_console.tui.console.model import Kind
from bot_console.tui.console.values import from_message, info
from rcl_interfaces.msg import ParameterDescriptor, ParameterValue


def test_an_unknown_type_code_gives_no_value() -> None:
    unknown = ParameterValue(type=120)
    assert from_message(unknown) is None
    assert info("/nav", unknown, ParameterDescriptor(name="speed", type=121), None).kind is Kind.NOT_SET
    assert info("/nav", unknown, ParameterDescriptor(name="speed", type=3), None).kind is Kind.DOUBLE
