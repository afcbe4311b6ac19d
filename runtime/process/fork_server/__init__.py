"""Real processes in milliseconds: forked from a server that has imported everything. Independent of ROS. POSIX only.

Here (the parent)
    `server = ForkServer("package.module:warm_up")`: starts it at once; it warms up while the parent continues.
    `server.start(job, stdin=, stdout=, stderr=, data=) -> descriptor`: start a child with these descriptors. The
    returned descriptor delivers its pid and its exit code, see `Report`. `data` is a pipe for the child's own reports.
    `server.close()`: ends the children as a closing terminal does, then the server. The same happens when the parent
    dies in whatever way.

There (the server)
    It has one thread, and no socket but the parent's. It calls `warm_up()` once and forks a child for each `Job`.

The child
    It has its own session and random numbers, the given directory, environment, arguments and standard streams, and
    default signals. `Job.program` names a function that, called with `Job.arguments`, returns the program; that runs
    as `__main__` does: its exceptions, `SystemExit`, Ctrl-C and threads end it as they end any Python process.
"""

from __future__ import annotations

from .client import ForkServer
from .job import Job, function_named
from .prefork import has_one_thread
from .report import Report

__all__ = ["ForkServer", "Job", "Report", "function_named", "has_one_thread"]
