"""Remap rules."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from launch.substitution import Substitution
from launch.utilities import ensure_argument_type, normalize_to_list_of_substitutions

Rule = tuple[tuple[Substitution, ...], tuple[Substitution, ...]]


def normalize_remap_rule(remap_rule: Any) -> Rule:
    """Return both sides as substitutions; raises `TypeError` for anything but a pair."""
    ensure_argument_type(remap_rule, (tuple,), "remap_rule")
    if len(remap_rule) != 2:
        raise TypeError(f"remap_rule must be a tuple of length 2, got length {len(remap_rule)}")
    source, target = (tuple(normalize_to_list_of_substitutions(each)) for each in remap_rule)
    return source, target


def normalize_remap_rules(remap_rules: Iterable[Any]) -> Iterable[Rule]:
    """Normalize several rules."""
    for each in remap_rules:
        yield normalize_remap_rule(each)
