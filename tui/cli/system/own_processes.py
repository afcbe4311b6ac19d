"""Nodes in processes of their own: what a user wrote gets one where programs of this machine can meet."""

from __future__ import annotations

from bot_console.runtime.rmw.zenoh.domain.domain_bus import is_in_range, share_domains

SHARE = f"{share_domains.__module__}:{share_domains.__name__}"


def isolate() -> None:
    """Run a user's nodes in processes of their own, unless a launch says `isolation:=thread`.

    To be called by programs that take part in their domain, after the runtime was installed. Processes that the
    environment lets nobody find would be alone: there all nodes stay in this one.
    """
    from launch.child import begin_children_with
    from launch.isolation import isolate_by_default

    if is_in_range():
        begin_children_with(SHARE)
        isolate_by_default("process")
