"""A publisher with a cache: its token has Zenoh's name, and it can be undeclared at any moment."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest
from bot_console.runtime.rmw.zenoh.domain.mesh import open_session
from bot_console.runtime.rmw.zenoh.transient_local_publisher import TransientLocalPublisher

TIMEOUT_S = 240.0

TAKEN_BACK_WHILE_A_SAMPLE_COMES_IN = f"""
import faulthandler, sys, threading, time

faulthandler.dump_traceback_later({TIMEOUT_S}, exit=True)

from bot_console.runtime.rmw.zenoh.domain.mesh import open_session

own, other = open_session(0), open_session(0)
came = threading.Event()


def received(payload, attachment):
    came.set()
    while "undeclare" not in (frame.f_code.co_name for frame in frames(taker.ident)):
        time.sleep(0.001)


def frames(ident):
    frame = sys._current_frames().get(ident)
    while frame:
        yield frame
        frame = frame.f_back


own.declare_subscriber("t", received, history=2)
publisher = own.declare_publisher("t", cache=2)
taker = threading.Thread(target=lambda: (came.wait(), publisher.undeclare()))
taker.start()
sender = other.declare_publisher("t", cache=2)
while not came.wait(0.05):
    sender.put(b"1", b"a")
taker.join()
print("taken back", flush=True)
import os
os._exit(0)
"""


TAKEN_BACK_WHILE_THE_SESSION_IS_LOCKED = f"""
import faulthandler, sys, threading, time

faulthandler.dump_traceback_later({TIMEOUT_S}, exit=True)

import zenoh
from bot_console.runtime.rmw.zenoh.domain.mesh import open_session

own, other = open_session(0), open_session(0)
seen, came = threading.Event(), threading.Event()
own.watch_tokens("there", lambda key, there: seen.set())
other.declare_token("there")
seen.wait()
publisher = own.declare_publisher("t", cache=2)
publisher.inner._token.undeclare()  # which would wait for that lock first, and leave Python's to others meanwhile
publisher.inner._token = None


def replied(reply):  # Zenoh holds the lock of its session meanwhile
    came.set()
    while "undeclare" not in (frame.f_code.co_name for frame in frames(taker.ident)):
        time.sleep(0.001)
    time.sleep(0.1)  # it is in Zenoh by now, and needs that lock


def frames(ident):
    frame = sys._current_frames().get(ident)
    while frame:
        yield frame
        frame = frame.f_back


taker = threading.Thread(target=lambda: (came.wait(), publisher.undeclare()))
taker.start()
own._zenoh.liveliness().get("there", zenoh.handlers.Callback(replied, indirect=False))
taker.join()
print("taken back", flush=True)
import os
os._exit(0)
"""


@pytest.mark.parametrize("misses", [True, False])
def test_token_has_the_name_given_by_zenoh(socket_folder: object, misses: bool) -> None:
    session = open_session(0)
    try:
        inner = session._zenoh
        assert inner is not None
        import zenoh

        keeping = TransientLocalPublisher(zenoh.ext, inner, "t", {}, 2, misses=misses)
        theirs = zenoh.ext.declare_advanced_publisher(
            *(inner, "t"),
            cache=zenoh.ext.CacheConfig(2),
            sample_miss_detection=zenoh.ext.MissDetectionConfig() if misses else None,
            publisher_detection=True,
        )
        names = [str(each.id.eid) if misses else "uhlc" for each in (keeping._publisher, theirs)]
        found = {str(each.ok.key_expr) for each in inner.liveliness().get("t/@adv/pub/**") if each.ok}
        assert found == {f"t/@adv/pub/{theirs.id.zid}/{name}/_" for name in names}
        keeping.undeclare()
        theirs.undeclare()
    finally:
        session.close()


@pytest.mark.parametrize(
    "program",
    [TAKEN_BACK_WHILE_A_SAMPLE_COMES_IN, TAKEN_BACK_WHILE_THE_SESSION_IS_LOCKED],
    ids=["while a sample comes in", "while the session is locked"],
)
def test_publisher_can_be_undeclared_at_any_moment(socket_folder: object, program: str) -> None:
    done = subprocess.run(
        [sys.executable, "-c", program],
        env=dict(os.environ),
        check=False,
        capture_output=True,
        text=True,
        timeout=2 * TIMEOUT_S,
    )
    assert done.stdout == "taken back\n", done.stderr
