"""Differences between Python versions that tests have to know."""

from __future__ import annotations

import sys

import pytest

PDB_TAKES_NO_OPTIONS = pytest.mark.skipif(
    sys.version_info[:3] == (3, 13, 0), reason="pdb of Python 3.13.0 passes no options to the program"
)
