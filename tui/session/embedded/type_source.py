"""Makes interfaces from the definitions that nodes send, for types that the console does not have."""

from __future__ import annotations

from collections.abc import Generator, Mapping
from typing import Any


class DomainTypes:
    """A `TypeSource` based on the runtime."""

    def inquiries(self, domain: int, type_name: str) -> Mapping[str, Generator[tuple[str, str], Any, str]]:
        """The queries to send for a type, by node of another process that can be asked."""
        from bot_console.runtime.type_inquiry import inquiries

        return inquiries(domain, type_name)
