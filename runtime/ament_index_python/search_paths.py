"""The prefixes that the ament index searches."""

from ament_index_python.resources import get_search_paths

__all__ = ["get_search_paths"]
