"""A process of the mesh tests: joins domain 0, writes its session's id, and then obeys one word per line.

`linked` writes the ids of the sessions it has a link to; `call` publishes its id; `heard` writes the ids it has
received; `exit` closes the session and writes how long that took, in s.
"""

import sys
import time

from bot_console.runtime.rmw.zenoh.domain.mesh import open_session

session = open_session(0)
session.watch()
heard: set[str] = set()
session.declare_subscriber("call", lambda payload, _: heard.add(payload.decode()))
publisher = session.declare_publisher("call")
print(session.zid, flush=True)

for word in sys.stdin:
    match word.strip():
        case "linked":
            print(*session.linked(), flush=True)
        case "call":
            publisher.put(session.zid.encode(), b"")
            print("called", flush=True)
        case "heard":
            print(*heard, flush=True)
        case "exit":
            began = time.monotonic()
            session.close()
            print(time.monotonic() - began, flush=True)
            break
