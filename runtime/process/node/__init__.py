"""The node process: a thread with the attributes of a process, from its start to its exit code."""
