"""The node process: a thread with what a process has, from its start to its exit code."""
