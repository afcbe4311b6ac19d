"""Output filters that also ignore lines printed by a middleware."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ament_index_python import get_resource, has_resource
from launch_testing.tools import output


def get_rmw_output_filter(rmw_implementation: str, filter_type: str) -> list[str]:
    """Return a middleware's own lines, "prefixes" or "patterns"; raises `TypeError` for another filter type."""
    supported = ["prefixes", "patterns"]
    if filter_type not in supported:
        raise TypeError(f'Unsupported filter_type "{filter_type}". Supported types: {supported}')
    kind = f"rmw_output_{filter_type}"
    return get_resource(kind, rmw_implementation)[0].splitlines() if has_resource(kind, rmw_implementation) else []


def basic_output_filter(
    filtered_prefixes: Sequence[str] | None = None,
    filtered_patterns: Sequence[str] | None = None,
    filtered_rmw_implementation: str | None = None,
) -> Callable[[str], str]:
    """Return the filter of `launch_testing`, extended to remove a middleware's lines."""
    prefixes = output.get_default_filtered_prefixes() if filtered_prefixes is None else list(filtered_prefixes)
    patterns = output.get_default_filtered_patterns() if filtered_patterns is None else list(filtered_patterns)
    if filtered_rmw_implementation:
        prefixes += get_rmw_output_filter(filtered_rmw_implementation, "prefixes")
        patterns += get_rmw_output_filter(filtered_rmw_implementation, "patterns")
    return output.basic_output_filter(prefixes, patterns)
