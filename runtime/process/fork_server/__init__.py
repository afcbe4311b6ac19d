"""Real processes in milliseconds: forked from a server that has imported everything. Independent of ROS. POSIX only.

Here (the parent)
    `server = ForkServer("package.module:warm_up")`: starts it at once, warms up while the parent goes on.
    `server.start(job, stdin=, stdout=, stderr=, data=) -> descriptor`: start a child with these descriptors. From the
    one given back come its pid and its exit code, see `Report`. `data` is a pipe for what only the child knows.
    `server.close()`: the children are ended as a shell's are when it goes, then the server. So they are when the
    parent dies in whatever way.

There (the server)
    One thread, no sockets but the parent's. It calls `warm_up()` once and forks a child for each `Job`.

The child
    A session of its own, the given directory, environment, arguments and standard streams, default signals, and random
    numbers of its own. `Job.program` names a function that, called with `Job.arguments`, gives the program; that runs
    as `__main__` does: its exceptions, `SystemExit`, Ctrl-C and threads end it as they end any Python process.
"""

from __future__ import annotations

from .client import ForkServer
from .job import Job, function_named
from .prefork import has_one_thread
from .report import Report

__all__ = ["ForkServer", "Job", "Report", "function_named", "has_one_thread"]
