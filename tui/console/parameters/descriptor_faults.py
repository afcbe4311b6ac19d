"""Finds out what a parameter's descriptor lacks. Uses only the model."""

from __future__ import annotations

from bot_console.tui.console.model import Kind, ParameterInfo
from bot_console.tui.console.parameters.described_unit import is_dimensionless

NUMBERS = (Kind.INTEGER, Kind.DOUBLE)
NO_DESCRIPTION = "no description"


def faults(parameter: ParameterInfo) -> tuple[str, ...]:
    """The faults of a descriptor, in a few words each; none for parameters that every node has."""
    if parameter.name == "use_sim_time" or parameter.name.startswith(("qos_overrides.", "start_type_description")):
        return ()
    found: list[str] = []
    if not parameter.description.strip():
        found.append(NO_DESCRIPTION)
    if parameter.kind in NUMBERS and parameter.range is None and not parameter.read_only:
        found.append("no range")
    described = parameter.description.strip()
    if parameter.kind is Kind.DOUBLE and described and not parameter.unit and not is_dimensionless(described):
        found.append("no unit")
    return tuple(found)


HINTS = {
    NO_DESCRIPTION: "give declare_parameter a ParameterDescriptor(description=...)",
    "no range": "give the descriptor a floating_point_range or an integer_range, so that nonsense is refused",
    "no unit": "end the description with the unit in brackets, such as (m/s), or call the value a ratio or a share",
    "no validation": "add_on_set_parameters_callback, or ranges in the descriptors: now any value is taken",
    "accepts anything": "let the callback return successful=False with a reason for what it cannot work with",
    "float as int": "write the default with a point: 1 makes an integer parameter, and 0.5 is refused then",
    "dead key": "use the node's name, or /** for all; a key that means no node sets nothing",
    "refused": "a node that is given this file does not start",
    "dead parameter": "declare it in the node or take the line out: it sets nothing",
}
"""How to fix each fault."""
