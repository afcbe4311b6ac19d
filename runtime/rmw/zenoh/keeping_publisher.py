"""A Zenoh publisher that keeps its last samples for late subscribers, and that can be undeclared safely."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from bot_console.runtime.rmw.zenoh.declared import TAKEN


class KeepingPublisher:
    """Zenoh's advanced publisher, with the token by which subscribers find it declared apart.

    Taken back by Zenoh together with its publisher, the token goes while Python's global lock is held, and tells this
    session's subscribers of the same key under a lock of theirs. A sample that comes in at that moment has that lock
    and waits for Python's: everything would stand still for ever. A token of one's own goes with Python's released.

    For the same reason the publisher itself is dropped rather than undeclared: Zenoh undeclares it while Python's lock
    is held, waits there for the lock of the session, and may have to wait for a callback that has that and waits for
    Python's. Dropping releases Python's.
    """

    def __init__(
        self, ext: Any, session: Any, key: str, quality: Mapping[str, Any], kept: int, *, misses: bool
    ) -> None:
        """Keep that many samples; with `misses` subscribers are told of what they have missed. `ext` is `zenoh.ext`."""
        heartbeat = ext.MissDetectionConfig(heartbeat=None, sporadic_heartbeat=0.5) if misses else None
        cache = ext.CacheConfig(kept)
        self._publisher: Any = ext.declare_advanced_publisher(
            session, key, **quality, cache=cache, sample_miss_detection=heartbeat
        )
        # As Zenoh names it: samples are counted by publisher where misses are told, else by their time.
        counted_by = self._publisher.id.eid if misses else "uhlc"
        place = f"{key}/@adv/pub/{self._publisher.id.zid}/{counted_by}/_"
        self._token: Any = session.liveliness().declare_token(place)

    def put(self, payload: bytes, *, attachment: bytes) -> None:
        """Send one sample; raises `ZError`, and `RuntimeError` once it is taken back."""
        publisher = self._publisher
        if publisher is None:
            raise RuntimeError(TAKEN)
        publisher.put(payload, attachment=attachment)

    def undeclare(self) -> None:
        """Take it back, or have the thread do so that is just sending with it; raises `ZError`."""
        token, self._token = self._token, None
        if token is not None:
            token.undeclare()
        self._publisher = None
