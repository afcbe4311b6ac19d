"""Namespaces."""

from __future__ import annotations


def is_root_namespace(ns: str | None) -> bool:
    """Whether a namespace is `/`."""
    return ns == "/"


def is_namespace_absolute(ns: str | None) -> bool:
    """Whether a namespace begins with a slash."""
    return ns is not None and ns.startswith("/")


def make_namespace_absolute(ns: str | None) -> str | None:
    """Return the namespace with a leading slash."""
    return ns if ns is None or ns.startswith("/") else f"/{ns}"


def prefix_namespace(base_ns: str | None, ns: str | None) -> str | None:
    """Return a namespace or name below another namespace; an absolute one is returned unchanged."""
    if base_ns is None and ns is None:
        return None
    if ns is None:
        combined = base_ns or ""
    elif not base_ns or is_namespace_absolute(ns):
        combined = ns
    else:
        combined = f"{base_ns.rstrip('/')}/{ns}"
    return combined if is_root_namespace(combined) else combined.rstrip("/")
