"""The content filter that a subscription requests."""

from __future__ import annotations

from typing import NamedTuple


class ContentFilterOptions(NamedTuple):
    """A filter such as `linear.x > %0 AND data LIKE 'a%'`, in the SQL of DDS, and the values of `%0`, `%1` ..."""

    filter_expression: str
    expression_parameters: list[str]
