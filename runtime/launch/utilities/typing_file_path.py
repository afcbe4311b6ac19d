"""The type of file paths."""

from __future__ import annotations

import os

FilePath = str | bytes | os.PathLike[str] | os.PathLike[bytes]

__all__ = ["FilePath"]
