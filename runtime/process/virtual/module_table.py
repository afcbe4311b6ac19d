"""`sys.modules` of a node process: its own modules, in front of the shared ones."""

from __future__ import annotations

import sys
from collections.abc import Iterator, MutableMapping
from types import ModuleType


class ModuleTable(MutableMapping[str, ModuleType]):
    """The process's own modules in front of the real table; writes go to the real one unless the name is own."""

    def __init__(self, own: dict[str, ModuleType]) -> None:
        self._own = own
        self._shared: dict[str, ModuleType] = sys.__dict__["modules"]

    def __getitem__(self, name: str) -> ModuleType:
        try:
            return self._own[name]
        except KeyError:
            return self._shared[name]

    def __setitem__(self, name: str, module: ModuleType) -> None:
        table = self._own if name in self._own else self._shared
        table[name] = module

    def __delitem__(self, name: str) -> None:
        table = self._own if name in self._own else self._shared
        del table[name]

    def __iter__(self) -> Iterator[str]:
        return iter({**self._shared, **self._own})

    def __len__(self) -> int:
        return len(self._shared.keys() | self._own.keys())

    def __contains__(self, name: object) -> bool:
        return name in self._own or name in self._shared

    def copy(self) -> dict[str, ModuleType]:
        """Return the present content as a plain dict."""
        return {**self._shared, **self._own}
