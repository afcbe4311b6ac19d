"""Whether a parameter file is on a server; cheap to import, unlike the module that downloads the file."""

from __future__ import annotations

SCHEMES = ("https://", "http://")


def is_remote(place: str) -> bool:
    """Whether a parameter file is given by a URL rather than a path."""
    return place.lower().startswith(SCHEMES)
