"""Fixtures that run launch descriptions and launch files."""

from launching import log_lines, run, run_file

__all__ = ["log_lines", "run", "run_file"]
