"""Checks parameter declarations in a Python file, without running it."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from bot_console.tui.cli.lint.finding import LintFinding
from bot_console.tui.console.parameters.described_unit import is_dimensionless

_CONTINUOUS = re.compile(r"speed|velocity|distance|radius|gain|rate|angle|tolerance|timeout|period|^k[pid](_|$)|scale")
_UNIT = re.compile(r"(\([^()]*[A-Za-z°%][^()]*\)|\[[^\[\]]*[A-Za-z°%][^\[\]]*\])\s*$")


@dataclass
class DeclaredNames:
    """The names of a file's nodes, and the parameters they declare."""

    nodes: set[str] = field(default_factory=set[str])
    parameters: set[str] = field(default_factory=set[str])
    whole: bool = True
    """Whether all parameter names are known; one that is computed at run time is not."""


def lint(path: Path) -> tuple[list[LintFinding], DeclaredNames]:
    """The faults of a file, and the names that it declares; raises `SyntaxError` if it is not valid Python."""
    tree = ast.parse(path.read_text(encoding="utf-8"), str(path))
    found: list[LintFinding] = []
    declared = DeclaredNames()
    for each in ast.walk(tree):
        if isinstance(each, ast.ClassDef):
            found += _class_findings(each, str(path))
        if isinstance(each, ast.Call):
            _collect_names(each, declared)
            if _called(each) == "declare_parameter":
                found += _declaration_findings(each, str(path), tree)
    return found, declared


def _called(call: ast.Call) -> str:
    return _last_name(call.func)


def _last_name(of: ast.expr) -> str:
    if isinstance(of, ast.Attribute):
        return of.attr
    return of.id if isinstance(of, ast.Name) else ""


def _collect_names(call: ast.Call, declared: DeclaredNames) -> None:
    """Collect the names of parameters and of nodes: `super().__init__("it")`, `create_node("it")`, `name="it"`."""
    name = _called(call)
    first = call.args[0] if call.args else None
    if name == "declare_parameter":
        if isinstance(first, ast.Constant) and isinstance(first.value, str):
            declared.parameters.add(first.value)
        else:
            declared.whole = False
    elif name == "declare_parameters":
        declared.whole = False
    elif name in ("__init__", "create_node") and isinstance(first, ast.Constant) and isinstance(first.value, str):
        declared.nodes.add(first.value)
    for each in call.keywords:
        if each.arg == "name" and isinstance(each.value, ast.Constant) and isinstance(each.value.value, str):
            declared.nodes.add(each.value.value)


def _declaration_findings(call: ast.Call, path: str, tree: ast.AST) -> Iterator[LintFinding]:
    if not call.args or not isinstance(call.args[0], ast.Constant) or not isinstance(call.args[0].value, str):
        return
    name = call.args[0].value
    given = {each.arg: each.value for each in call.keywords}
    default = call.args[1] if len(call.args) > 1 else given.get("value")
    descriptor = call.args[2] if len(call.args) > 2 else given.get("descriptor")
    number = _number(default)
    texts, ranges, known = _read_descriptor(descriptor, tree)
    if known and not texts:
        yield LintFinding(path, call.lineno, "no description", name)
    if known and number is not None and not ranges:
        yield LintFinding(path, call.lineno, "no range", name)
    if isinstance(number, float) and texts and not any(_UNIT.search(each) or is_dimensionless(each) for each in texts):
        yield LintFinding(path, call.lineno, "no unit", name)
    if type(number) is int and "integer_range" not in ranges and _CONTINUOUS.search(name.rpartition(".")[2]):
        yield LintFinding(path, call.lineno, "float as int", name)


def _number(default: ast.expr | None) -> float | int | None:
    operand = default.operand if isinstance(default, ast.UnaryOp) else default
    if isinstance(operand, ast.Constant) and type(operand.value) in (int, float):
        return operand.value  # type: ignore[return-value] -- one of the two types
    return None


def _read_descriptor(descriptor: ast.expr | None, tree: ast.AST) -> tuple[list[str], set[str], bool]:
    """The descriptions in a descriptor, its kinds of ranges, and whether both could be determined."""
    if descriptor is None:
        return [], set(), True
    if isinstance(descriptor, ast.Name):
        assigned = [
            each.value
            for each in ast.walk(tree)
            if isinstance(each, ast.Assign)
            and any(isinstance(one, ast.Name) and one.id == descriptor.id for one in each.targets)
        ]
        if len(assigned) != 1:
            return [], set(), False
        descriptor = assigned[0]
    if not isinstance(descriptor, ast.Call) or _called(descriptor) != "ParameterDescriptor":
        return [], set(), False  # made by a helper, so that nothing can be determined here
    given = {each.arg: each.value for each in descriptor.keywords}
    ranges = {"floating_point_range", "integer_range"} & set(given)
    text = given.get("description")
    texts = [text.value] if isinstance(text, ast.Constant) and isinstance(text.value, str) and text.value else []
    if text is not None and not isinstance(text, ast.Constant):
        return [], ranges, False
    return texts, ranges, True


def _class_findings(node: ast.ClassDef, path: str) -> Iterator[LintFinding]:
    """The faults of a node class: it does not validate parameters, or its validation accepts everything."""
    calls = [each for each in ast.walk(node) if isinstance(each, ast.Call)]
    names = {_called(each) for each in calls}
    if "declare_parameter" in names and "add_on_set_parameters_callback" not in names:
        ranged = any("range" in (keyword.arg or "") for each in calls for keyword in each.keywords)
        helped = any(
            _called(each) == "declare_parameter" and len(each.args) > 2 and _called_name(each.args[2]) not in
            ("", "ParameterDescriptor") for each in calls
        )  # fmt: skip
        if not ranged and not helped:
            yield LintFinding(path, node.lineno, "no validation", node.name)
    for call in calls:
        if _called(call) == "add_on_set_parameters_callback" and call.args:
            callback = _called_name(call.args[0])
            for each in ast.walk(node):
                if isinstance(each, ast.FunctionDef) and each.name == callback and not _can_refuse(each):
                    yield LintFinding(path, each.lineno, "accepts anything", f"{node.name}.{each.name}")


def _called_name(of: ast.expr) -> str:
    return _called(of) if isinstance(of, ast.Call) else _last_name(of)


def _can_refuse(callback: ast.FunctionDef) -> bool:
    """Whether `successful` can be anything but True; if the result is made elsewhere, it is assumed to."""
    return any(_may_refuse(each) for each in ast.walk(callback))


def _may_refuse(each: ast.AST) -> bool:
    if isinstance(each, ast.keyword):
        return each.arg == "successful" and not _is_true(each.value)
    if isinstance(each, ast.Assign):
        named = any(isinstance(one, ast.Attribute) and one.attr == "successful" for one in each.targets)
        return named and not _is_true(each.value)
    if isinstance(each, ast.Return):
        calls = [one for one in ast.walk(each) if isinstance(one, ast.Call)]
        return any(_called(one) != "SetParametersResult" for one in calls)
    return isinstance(each, ast.Raise)


def _is_true(value: ast.expr) -> bool:
    return isinstance(value, ast.Constant) and value.value is True
