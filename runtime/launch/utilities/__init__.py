"""Helpers that actions and programs share."""

from launch.utilities.class_tools import is_a, is_a_subclass, isclassinstance
from launch.utilities.create_futures import create_future
from launch.utilities.ensure_argument_type import ensure_argument_type
from launch.utilities.normalize_to_list_of_entities import normalize_to_list_of_entities
from launch.utilities.normalize_to_list_of_substitutions import normalize_to_list_of_substitutions
from launch.utilities.perform_substitutions import perform_substitutions
from launch.utilities.visit_entities import visit_all_entities_and_collect_futures

__all__ = [
    "create_future",
    "ensure_argument_type",
    "is_a",
    "is_a_subclass",
    "isclassinstance",
    "normalize_to_list_of_entities",
    "normalize_to_list_of_substitutions",
    "perform_substitutions",
    "visit_all_entities_and_collect_futures",
]
