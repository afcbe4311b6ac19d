"""The prefixes searched by the ament index."""

from ament_index_python.resources import get_search_paths

__all__ = ["get_search_paths"]
