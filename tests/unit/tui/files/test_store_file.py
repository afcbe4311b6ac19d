"""Reading a kept file, whatever has taken its place."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from bot_console.tui.files.store_file import read_store


@pytest.mark.skipif(not Path("/proc/self/fd").is_dir(), reason="needs /proc to count open files")
def test_folder_in_the_place_of_a_file_is_named_and_leaves_nothing_open(tmp_path: Path) -> None:
    before = os.listdir("/proc/self/fd")
    with pytest.raises(OSError, match=f"directory: '{tmp_path}'"):
        read_store(tmp_path, 10)
    assert os.listdir("/proc/self/fd") == before
