"""Checks for the optional library that bags need."""

from __future__ import annotations

INSTALL = "pip install 'bot-console[bags]'"


class MissingPackageError(RuntimeError):
    """The library that writes and reads bags is not installed; the text says how to install it."""


def check() -> None:
    """Raise `MissingPackageError` if `mcap` is not installed."""
    try:
        import mcap.writer  # noqa: F401 # pyright: ignore[reportUnusedImport] # to see that it is there
    except ImportError as error:
        raise MissingPackageError(f"bags need the package mcap ({error}): {INSTALL}") from None
