"""Interfaces that are not installed here: definitions received from nodes, kept for the lifetime of this process.

Only packages that are missing entirely are learned, so that nothing installed is hidden, and only definitions whose
hash matches the type's in the graph.
"""

from __future__ import annotations

import importlib
import re
import sys
from collections.abc import Iterable, Mapping
from functools import cache
from typing import TYPE_CHECKING, Any

from bot_console.runtime.rosidl.names import KINDS

if TYPE_CHECKING:
    import tempfile
    from pathlib import Path

TYPE_NAME = rf"[a-z][a-z0-9_]*/(?:{'|'.join(KINDS)})/[A-Z][A-Za-z0-9]*"
"""The pattern of valid names of folders and files, which come from another program or machine; compiled when needed."""
FALSE = "describes it by a definition that does not have the hash"
UNREADABLE = "sent a description of it that is invalid"

_folders: dict[str, Path] = {}


def learned_folders() -> Mapping[str, Path]:
    """Return the learned packages."""
    return _folders


def learn(type_name: str, type_hash: str, response: Any) -> str:
    """Learn from the response of a node's `get_type_description`, so that the type can be imported.

    Returns why it cannot be learned, as a sentence whose omitted subject is the node; empty on success.
    """
    from bot_console.runtime.rosidl.parse import DefinitionError

    refused = refusal(response)
    if refused:
        return refused
    texts = {each.type_name: each.raw_file_contents for each in response.type_sources if each.encoding in KINDS}
    try:
        if not all(re.fullmatch(TYPE_NAME, each) for each in (type_name, *texts)):
            raise DefinitionError("an invalid type name")
        if not _has_hash(type_name, type_hash, texts):
            return f"{FALSE} {type_hash}"
        _keep(texts)
        here = _hash_here(type_name)
    except (DefinitionError, ImportError, AttributeError, RecursionError) as error:
        return f"{UNREADABLE}: {error}"
    return "" if here == type_hash else "has definitions of its nested types that differ from those here"


def refusal(response: Any) -> str:
    """Return why a response of `get_type_description` is useless; empty if it is usable."""
    if response is None:
        return "has not described it"
    return "" if response.successful else f"does not describe it: {response.failure_reason}"


def _has_hash(type_name: str, type_hash: str, texts: Mapping[str, str]) -> bool:
    from bot_console.runtime.rosidl.received_descriptions import describe_texts
    from bot_console.runtime.rosidl.type_hash import text_of_description

    return text_of_description(describe_texts(type_name, texts)) == type_hash


def _hash_here(type_name: str) -> str:
    """Return the hash of the class that is imported under this name."""
    from bot_console.runtime.rosidl.type_hash import text

    package, kind, short = type_name.split("/")
    return text(getattr(importlib.import_module(f"{package}.{kind}"), short))


def _keep(texts: Mapping[str, str]) -> None:
    """Write the definitions to where imports find them; an existing package stays unchanged."""
    import importlib.util

    new: list[str] = []
    for name, text in texts.items():
        package, kind, short = name.split("/")
        if package not in _folders and importlib.util.find_spec(package) is not None:
            continue
        folder = _directory() / package / kind
        folder.mkdir(parents=True, exist_ok=True)
        place = folder / f"{short}.{kind}"
        if not place.exists():
            place.write_text(text, encoding="utf-8")
            new.append(f"{package}.{kind}")
        _folders[package] = _directory() / package
    _report_more(new)


def _report_more(modules: Iterable[str]) -> None:
    """Make modules that were imported before they had all their classes list them again."""
    for name in dict.fromkeys(modules):
        if name in sys.modules:
            importlib.reload(sys.modules[name])


@cache
def _temporary_directory() -> tempfile.TemporaryDirectory[str]:
    import tempfile

    return tempfile.TemporaryDirectory(prefix="bot-console-interfaces-")


def _directory() -> Path:
    from pathlib import Path

    return Path(_temporary_directory().name)
