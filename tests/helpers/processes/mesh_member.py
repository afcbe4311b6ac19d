"""A process of the mesh tests: it joins domain 0, writes its session's id, and then obeys one command per line.

Ids are given by their first eight digits. `linked` writes the ids of the sessions to which it has a link; `call`
publishes its id; `heard` writes the ids it has received; `answer` those of the sessions that respond to a query; `exit`
closes the session and writes how long that took, in s. With the argument `hasty` its first session gives up links that
take 5 ms, and the watch has short timeouts. With `unwatched` it does not watch its socket folder, and so does not
remove a note that it is in a debugger. With `crowded` it has as many declarations as 400 nodes.
"""

import sys
import time

from bot_console.runtime.rmw.zenoh import settings
from bot_console.runtime.rmw.zenoh.domain import watch
from bot_console.runtime.rmw.zenoh.domain.mesh import open_session

timeout_s = settings.OPEN_TIMEOUT_MS
if "hasty" in sys.argv:
    settings.OPEN_TIMEOUT_MS = 5
    watch.LINK_TIMEOUT_S = 3.0
session = open_session(0)
settings.OPEN_TIMEOUT_MS = timeout_s
if "unwatched" not in sys.argv:
    session.watch()
heard: set[str] = set()
session.declare_subscriber("call", lambda payload, _: heard.add(payload.decode()))
publisher = session.declare_publisher("call")
if "crowded" in sys.argv:
    for number in range(1600):
        session.declare_token(f"{number}/{'x' * 1000}")
print(session.zid[:8], flush=True)

for word in sys.stdin:
    match word.strip():
        case "linked":
            print(*(each[:8] for each in session.linked()), flush=True)
        case "call":
            publisher.put(session.zid[:8].encode(), b"")
            print("called", flush=True)
        case "heard":
            print(*heard, flush=True)
        case "answer":
            print(*session.answering_sessions(timeout=0.3), flush=True)
        case "exit":
            began = time.monotonic()
            session.close()
            print(time.monotonic() - began, flush=True)
            break
