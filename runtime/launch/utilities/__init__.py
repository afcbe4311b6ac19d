"""Helpers that actions and programs share."""

from launch.utilities.normalize_to_list_of_substitutions import normalize_to_list_of_substitutions
from launch.utilities.perform_substitutions import perform_substitutions

__all__ = ["normalize_to_list_of_substitutions", "perform_substitutions"]
