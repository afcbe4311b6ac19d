"""Parameters: a name, a type and a value."""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING, Any, cast

from bot_console.runtime.distribution import distribution
from bot_console.runtime.rmw.parameter_types import ARRAYS, BY_CLASS, BY_CODE, STRING
from rclpy.impl.parameter_file_sections import chosen_values
from rclpy.impl.parameter_values import FIELDS, infer, value_fits
from rclpy.impl.reexports import reexporting

if TYPE_CHECKING:
    from rcl_interfaces.msg import Parameter as ParameterMsg
    from rcl_interfaces.msg import ParameterValue

    _TypeBase = Enum
else:
    _TypeBase = distribution().parameter_type_base

PARAMETER_SEPARATOR_STRING = "."


class Parameter:
    """An immutable parameter."""

    class Type(_TypeBase):
        """Parameter types; the values are those of `rcl_interfaces/msg/ParameterType`."""

        NOT_SET = 0
        BOOL = 1
        INTEGER = 2
        DOUBLE = 3
        STRING = 4
        BYTE_ARRAY = 5
        BOOL_ARRAY = 6
        INTEGER_ARRAY = 7
        DOUBLE_ARRAY = 8
        STRING_ARRAY = 9

        @classmethod
        def from_parameter_value(cls, parameter_value: Any) -> Parameter.Type:
            """Return the parameter type of a Python value; raises `TypeError` for any other value."""
            return cls(infer(parameter_value))

        def check(self, parameter_value: Any) -> bool:
            """Whether a parameter of this type may hold the value."""
            return value_fits(self.value, parameter_value)

    def __init__(self, name: str, type_: Parameter.Type | None = None, value: Any = None) -> None:
        exact = _EXACT.get(value.__class__)
        if type_ is None:
            type_ = Parameter.Type.from_parameter_value(value) if exact is None else exact
        if type_ is not exact:
            if not isinstance(type_, Parameter.Type):  # pyright: ignore[reportUnnecessaryIsInstance] -- a user's argument
                raise TypeError(f"type must be an instance of '{Parameter.Type!r}'")
            if not type_.check(value):
                raise ValueError(f"Type '{type_}' and value '{value}' do not agree")
        self._type_ = type_
        self._name = name
        self._value = value

    @classmethod
    def from_parameter_msg(cls, param_msg: ParameterMsg) -> Parameter:
        """Return the parameter in a message; raises `ValueError` for an unknown type."""
        type_ = Parameter.Type(param_msg.value.type)
        field = FIELDS.get(type_.value)
        return cls(param_msg.name, type_, None if field is None else getattr(param_msg.value, field))

    @property
    def name(self) -> str:
        """The full name, including dots."""
        return self._name

    @property
    def type_(self) -> Parameter.Type:
        """The type."""
        return self._type_

    @property
    def value(self) -> Any:
        """The value as it was given; None for NOT_SET."""
        return self._value

    def get_parameter_value(self) -> ParameterValue:
        """Return the value as a message."""
        from rcl_interfaces.msg import ParameterValue

        code = self._type_.value
        field = FIELDS.get(code)
        return ParameterValue(type=code) if field is None else ParameterValue(type=code, **{field: self._value})

    def to_parameter_msg(self) -> ParameterMsg:
        """Return the parameter as a message."""
        from rcl_interfaces.msg import Parameter as ParameterMsg

        return ParameterMsg(name=self._name, value=self.get_parameter_value())


_EXACT: dict[type, Parameter.Type] = {kind: Parameter.Type(each.code) for kind, each in BY_CLASS.items()}
_YAML_ARRAYS = tuple((each.python, each.code) for each in ARRAYS if each.python is not bytes)  # YAML has no bytes


def get_parameter_value(string_value: str) -> ParameterValue:
    """Return the value of a text in YAML 1.1, as `ros2 param set` reads it; raises `yaml.YAMLError`."""
    from rcl_interfaces.msg import ParameterValue

    value = _yaml_value(string_value)
    code = _yaml_type(value)
    if code is None:
        # Upstream treats everything else as a string: mixed lists as their text, the rest unchanged.
        return ParameterValue(type=STRING.code, string_value=string_value if isinstance(value, list) else value)
    return ParameterValue(type=code, **{FIELDS[code]: value})


def _yaml_value(text: str) -> Any:
    """Return the value of a text in YAML; the text itself if its value is null or it cannot be parsed."""
    from bot_console.runtime.rmw.plain_yaml import plain_scalar

    # Values that are not strings are left to the YAML library, which raises its own error.
    plain = plain_scalar(text) if isinstance(text, str) else None  # pyright: ignore[reportUnnecessaryIsInstance] -- a user's argument
    if plain is not None:
        return plain
    import yaml
    from yaml.parser import ParserError

    try:
        value = yaml.safe_load(text)
    except ParserError:
        return text
    return text if value is None else value


def _yaml_type(value: Any) -> int | None:
    """Return the type code of a value read from YAML, or None; an empty list counts as a list of booleans."""
    if isinstance(value, list):
        items = cast("list[Any]", value)
        for kind, code in _YAML_ARRAYS:
            if all(isinstance(each, kind) for each in items):
                return code
        return None
    exact = _EXACT.get(value.__class__)
    return None if exact is None else exact.value


def parameter_value_to_python(parameter_value: ParameterValue) -> Any:
    """Return the Python value of a message, arrays as lists, None for NOT_SET; `RuntimeError` for other types."""
    code = parameter_value.type
    if code == 0:
        return None
    kind = BY_CODE.get(code)
    if kind is None:
        raise RuntimeError(f"unexpected parameter type {code}")
    value = getattr(parameter_value, kind.field)
    return list(value) if kind.is_array else value


def parameter_dict_from_yaml_file(
    parameter_file: str,
    use_wildcard: bool = False,
    target_nodes: list[str] | None = None,
    namespace: str = "",
) -> dict[str, ParameterMsg]:
    """Return the parameters of a file, by name; without `target_nodes`, those of all nodes.

    Nodes are named as in any parameter file (`talker`, `/robot1/talker`, `/robot1:` over `talker:`); keys with a
    wildcard (`/**`, `/*/talker`) count if `use_wildcard` is true, and other keys override them. Raises `RuntimeError`
    for a file without the wanted parameters, `OSError` and `yaml.YAMLError`.
    """
    import yaml

    with open(parameter_file, encoding="utf-8") as file:
        try:
            content = yaml.safe_load(file)
        except (
            TypeError,
            AttributeError,
            LookupError,
            OverflowError,
        ):  # the library's constructors of tagged values raise these
            raise RuntimeError(f"{parameter_file}: a value does not match its tag") from None
    return _unpack_parameter_dict(namespace, chosen_values(content, use_wildcard, target_nodes))


def _unpack_parameter_dict(namespace: str, parameter_dict: dict[str, Any]) -> dict[str, ParameterMsg]:
    """Flatten nested parameters; each name is prefixed with the namespace, which ends with a dot."""
    from rcl_interfaces.msg import Parameter as ParameterMsg

    parameters: dict[str, ParameterMsg] = {}
    for name, value in parameter_dict.items():
        full_name = namespace + name
        if isinstance(value, dict):
            below = cast("dict[str, Any]", value)
            parameters.update(_unpack_parameter_dict(full_name + PARAMETER_SEPARATOR_STRING, below))
        else:
            parameters[full_name] = ParameterMsg(name=full_name, value=get_parameter_value(str(value)))
    return parameters


__getattr__ = reexporting(__name__, "ParameterMsg ParameterType ParameterValue")
