"""The source of a message module, which is written when a package is built or first imported."""

from bot_console.runtime.rosidl.emit import modules
from bot_console.runtime.rosidl.parse import parse


def test_default_of_a_field_is_a_constant_of_the_class() -> None:
    (source,) = modules(parse("float64 volts 1.5\nfloat64 amperes\n", "charger", "msg", "Level")).values()
    assert [line.strip() for line in source.splitlines() if "__DEFAULT = " in line] == ["VOLTS__DEFAULT = 1.5"]
