"""The prefixes in which the ament index is searched."""

from ament_index_python.resources import get_search_paths

__all__ = ["get_search_paths"]
