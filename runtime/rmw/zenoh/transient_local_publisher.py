"""A Zenoh publisher that keeps its last samples for late subscribers and can be undeclared safely."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from bot_console.runtime.rmw.zenoh.declarations import TAKEN


class TransientLocalPublisher:
    """Zenoh's advanced publisher, with its detection token declared separately.

    If Zenoh undeclared the token together with the publisher, it would do so while holding the GIL, and would notify
    this session's subscribers of the same key under one of their locks. The delivery of a sample that arrives at that
    moment holds that lock and waits for the GIL: a deadlock. A token of our own is undeclared with the GIL released.

    For the same reason the publisher itself is dropped rather than undeclared: Zenoh's undeclare holds the GIL while it
    waits for the session's lock, and may have to wait for a callback that holds this lock and waits for the GIL.
    Dropping the publisher releases the GIL.
    """

    def __init__(
        self, ext: Any, session: Any, key: str, quality: Mapping[str, object], kept: int, *, misses: bool
    ) -> None:
        """Keep the last `kept` samples; `misses` lets subscribers detect lost ones. `ext` is the module `zenoh.ext`."""
        heartbeat = ext.MissDetectionConfig(heartbeat=None, sporadic_heartbeat=0.5) if misses else None
        cache = ext.CacheConfig(kept)
        self._publisher: Any = ext.declare_advanced_publisher(
            session, key, **quality, cache=cache, sample_miss_detection=heartbeat
        )
        # Zenoh's naming: the entity id if samples are numbered for miss detection, else "uhlc" for their timestamps.
        counted_by = self._publisher.id.eid if misses else "uhlc"
        place = f"{key}/@adv/pub/{self._publisher.id.zid}/{counted_by}/_"
        self._token: Any = session.liveliness().declare_token(place)

    def put(self, payload: bytes, *, attachment: bytes) -> None:
        """Send one sample; raises `ZError`, and `RuntimeError` once the publisher is undeclared."""
        publisher = self._publisher
        if publisher is None:
            raise RuntimeError(TAKEN)
        publisher.put(payload, attachment=attachment)

    def undeclare(self) -> None:
        """Undeclare the publisher; a thread that is still sending with it does so when done. Raises `ZError`."""
        token, self._token = self._token, None
        if token is not None:
            token.undeclare()
        self._publisher = None
