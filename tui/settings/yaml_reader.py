"""Reads and writes the console's own files as plain data in YAML; PyYAML is imported when a file first needs it.

Importing it takes a twentieth of the time to the first frame. Files that only the program itself writes, and reads at
each start, are JSON, which is also YAML.
"""

from __future__ import annotations

import json


class NotPlainData(ValueError):
    """A file cannot be read; the message says why, on one line."""


def read_yaml(content: bytes) -> object:
    """The data of a file; raises `NotPlainData`."""
    if content.startswith(b"{"):
        try:
            return json.loads(content)
        except (ValueError, RecursionError):  # YAML's own flow syntax
            pass
    import yaml
    from bot_console.tui.text.yaml_faults import UNREADABLE, fault_of

    try:
        return yaml.load(content, getattr(yaml, "CSafeLoader", yaml.SafeLoader))
    except UNREADABLE as error:
        raise NotPlainData(fault_of(error)) from None


def to_yaml(data: object, *, flow: bool | None = False, allow_unicode: bool = False) -> str:
    """Data as YAML; with `flow` None, only the innermost collections are in flow style."""
    import yaml

    return yaml.safe_dump(data, sort_keys=False, default_flow_style=flow, allow_unicode=allow_unicode)
