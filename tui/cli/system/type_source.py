"""Interfaces made of what nodes tell of them, for a console whose own types do not suffice."""

from __future__ import annotations

from collections.abc import Generator, Mapping
from typing import Any


class DomainTypes:
    """`TypeSource` over the runtime."""

    def inquiries(self, domain: int, type_name: str) -> Mapping[str, Generator[tuple[str, str], Any, str]]:
        """What to ask for a type, by the nodes of other processes that can be asked."""
        from bot_console.runtime.type_inquiry import inquiries

        return inquiries(domain, type_name)
