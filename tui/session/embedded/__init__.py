"""The session's imports from the runtime: its domain, workspace, processes and log files."""
