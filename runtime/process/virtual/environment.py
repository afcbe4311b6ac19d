"""Each node process's own copy of `os.environ`, which its child processes inherit."""

from __future__ import annotations

import os
from collections.abc import Iterator, MutableMapping

from ..node.thread_state import local

_real = os.environ


def _key(key: str) -> str:
    return key.upper() if os.name == "nt" else key


def _text(value: object) -> str:
    if not isinstance(value, str):
        raise TypeError(f"str expected, not {type(value).__name__}")
    return value


class RoutingEnvironment(MutableMapping[str, str]):
    """Reads and writes the environment of the calling thread's node process, or the real one."""

    @staticmethod
    def _mapping() -> MutableMapping[str, str]:
        process = local.process
        return _real if process.main_state is None else process.env

    def __getitem__(self, key: str) -> str:
        return self._mapping()[_key(_text(key))]

    def __setitem__(self, key: str, value: str) -> None:
        self._mapping()[_key(_text(key))] = _text(value)

    def __delitem__(self, key: str) -> None:
        del self._mapping()[_key(_text(key))]

    def __iter__(self) -> Iterator[str]:
        return iter(list(self._mapping()))

    def __len__(self) -> int:
        return len(self._mapping())

    def __contains__(self, key: object) -> bool:
        return isinstance(key, str) and _key(key) in self._mapping()

    def __repr__(self) -> str:
        return f"environ({dict(self)!r})"

    def copy(self) -> dict[str, str]:
        """Return the present content as a plain dict."""
        return dict(self._mapping())

    def __or__(self, other: MutableMapping[str, str]) -> dict[str, str]:
        return {**self, **other}

    def __ror__(self, other: MutableMapping[str, str]) -> dict[str, str]:
        return {**other, **self}

    def __ior__(self, other: MutableMapping[str, str]) -> RoutingEnvironment:
        self.update(other)
        return self
