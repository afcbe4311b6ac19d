"""The runtime's folders are those of platformdirs, which takes a launch too long to import."""

from __future__ import annotations

import sys

import platformdirs
import pytest
from bot_console.runtime.files import user_folders


@pytest.mark.skipif(sys.platform != "linux", reason="other systems use platformdirs")
@pytest.mark.parametrize("value", [None, "", " ", "/data/of mine"])
def test_folders_equal_those_of_platformdirs(value: str | None, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(user_folders.OVERRIDE, raising=False)
    user_folders._platform.cache_clear()
    for name in ("XDG_DATA_HOME", "XDG_CACHE_HOME"):
        if value is None:
            monkeypatch.delenv(name, raising=False)
        else:
            monkeypatch.setenv(name, value)
    found = user_folders.data_folder(), user_folders.cache_folder()
    user_folders._platform.cache_clear()
    names = "bot-console", False
    assert found == (platformdirs.user_data_path(*names), platformdirs.user_cache_path(*names))
